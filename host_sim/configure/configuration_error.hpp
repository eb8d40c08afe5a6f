/// A valid scene that cannot be turned into a working controller.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace sonoglide::configure {

/// what() says what is wrong with the value of key() and what is allowed.
class ConfigurationError : public std::runtime_error {
 public:
  ConfigurationError(std::string key, const std::string& message)
      : std::runtime_error(message), key_(std::move(key)) {}

  /// The key to change, `table.key`.
  const std::string& key() const { return key_; }

 private:
  std::string key_;
};

}  // namespace sonoglide::configure
