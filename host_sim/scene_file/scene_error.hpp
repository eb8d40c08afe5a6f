/// The error that every unusable scene ends in.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace sonoglide::scene_file {

/// A place in a scene file, or in the command line: file "--set" or "--vary", line the ordinal of the option.
struct Location {
  std::string file;
  std::size_t line = 1;
  std::size_t column = 1;
};

/// what() is one line, `FILE:LINE:COLUMN: KEY: MESSAGE`; the message says what is wrong and what is
/// allowed. Control characters that the file put into a name or value are shown escaped.
class SceneError : public std::runtime_error {
 public:
  SceneError(Location where, std::string key, std::string message);

  const std::string& file() const { return where_.file; }
  std::size_t line() const { return where_.line; }
  std::size_t column() const { return where_.column; }
  const std::string& key() const { return key_; }
  const std::string& message() const { return message_; }

 private:
  Location where_;
  std::string key_;
  std::string message_;
};

}  // namespace sonoglide::scene_file
