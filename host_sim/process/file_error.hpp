/// The error where a file cannot be read or written.
#pragma once

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

#include "host_sim/process/printable.hpp"

namespace sonoglide::process {

/// The file system refused, or holds what is somebody else's; the message names the path and the
/// reason.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// @throws FileError
[[noreturn]] inline void fail(const std::filesystem::path& path, const std::string& reason) {
  throw FileError(printable(path.string()) + ": " + reason);
}
[[noreturn]] inline void fail(const std::filesystem::path& path, const std::error_code& error) {
  fail(path, error.message());
}
/// The reason is that of the last system call.
[[noreturn]] inline void fail(const std::filesystem::path& path) {
  fail(path, std::error_code(errno, std::generic_category()));
}

}  // namespace sonoglide::process
