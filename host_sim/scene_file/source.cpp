#include "host_sim/scene_file/source.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <string_view>
#include <system_error>

#include "host_sim/process/printable.hpp"
#include "host_sim/scene_file/document.hpp"

namespace sonoglide::scene_file {
namespace {

constexpr std::string_view allowed_file = "allowed: a readable TOML file";

[[noreturn]] void fail_to_read(const std::string& file, std::string_view why) {
  throw SceneError({file, 1, 1}, "scene", fmt::format("{}; {}", why, allowed_file));
}

/// One byte more than a scene may have is enough to tell.
std::string bytes_of(std::istream& stream, const std::string& file) {
  std::string bytes(Document::max_bytes + 1, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (stream.bad()) {
    fail_to_read(file, "cannot be read");
  }
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  return bytes;
}

/// The stream of C tells a closed one from an empty one.
std::string bytes_of_standard_input() {
  std::string bytes = bytes_of(std::cin, Source::standard_input);
  if (bytes.empty() && std::fgetc(stdin) == EOF && std::ferror(stdin) != 0) {
    fail_to_read(Source::standard_input, "is closed or cannot be read");
  }
  return bytes;
}

}  // namespace

std::string Source::name() const {
  if (file == standard_input) {
    return "stdin";
  }
  const std::filesystem::path path(file);
  std::string name = path.stem().string();
  const std::string folder = path.parent_path().filename().string();
  const bool named_by_a_study = name == "scene" || name == "worst";
  if (named_by_a_study && folder.find_first_not_of('.') != std::string::npos) {
    name = fmt::format("{}_{}", folder, name);
  }
  return process::printable(name);
}

Source read_source(const std::filesystem::path& path) {
  if (path == "-") {
    return {Source::standard_input, bytes_of_standard_input()};
  }
  const std::string file = path.string();
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    fail_to_read(file, "is a directory");
  }
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    fail_to_read(file, std::generic_category().message(errno));
  }
  return {file, bytes_of(stream, file)};
}

}  // namespace sonoglide::scene_file
