/// An output that cannot be written.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

#include "host_sim/text/printable.hpp"

namespace sonoglide::output {

/// The file system refused, or holds what is somebody else's; the message names the path and the
/// reason.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// @throws OutputError
[[noreturn]] inline void fail(const std::filesystem::path& path, const std::string& reason) {
  throw OutputError(text::printable(path.string()) + ": " + reason);
}
[[noreturn]] inline void fail(const std::filesystem::path& path, const std::error_code& error) {
  fail(path, error.message());
}

}  // namespace sonoglide::output
