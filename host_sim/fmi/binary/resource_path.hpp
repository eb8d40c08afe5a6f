/// Where the resources of an FMU lie, as FMI 2.0 says it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace sonoglide::fmi {

#if defined(_WIN32)
inline constexpr bool has_drive_letters = true;
#else
inline constexpr bool has_drive_letters = false;
#endif

inline int digit_of(char digit) {
  return digit >= '0' && digit <= '9'   ? digit - '0'
         : digit >= 'a' && digit <= 'f' ? digit - 'a' + 10
         : digit >= 'A' && digit <= 'F' ? digit - 'A' + 10
                                        : -1;
}

/// The folder that a URI file:/…, file:///… or file://localhost/… names; a plain path is one too.
/// On Windows the / before a drive letter is none of the path.
/// Source: RFC 3986, 2.1, and RFC 8089.
inline std::string path_of(std::string_view uri) {
  constexpr std::string_view scheme = "file:";
  if (uri.substr(0, scheme.size()) != scheme) {
    return std::string(uri);
  }
  uri.remove_prefix(scheme.size());
  if (uri.substr(0, 2) == "//") {
    uri.remove_prefix(uri.find('/', 2) == std::string_view::npos ? 2 : uri.find('/', 2));
  }
  std::string path;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool escaped = uri[i] == '%' && i + 2 < uri.size() && digit_of(uri[i + 1]) >= 0 &&
                         digit_of(uri[i + 2]) >= 0;
    path += escaped ? static_cast<char>(digit_of(uri[i + 1]) * 16 + digit_of(uri[i + 2])) : uri[i];
    i += escaped ? 2 : 0;
  }
  if (has_drive_letters && path.size() > 2 && path[0] == '/' && path[2] == ':') {
    path.erase(0, 1);
  }
  return path;
}

}  // namespace sonoglide::fmi
