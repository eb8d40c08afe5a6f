#include "host_sim/scene/scene_error.hpp"

#include <fmt/format.h>

#include <utility>

namespace sonoglide::scene {
namespace {

std::string printable(const std::string& text) {
  std::string shown;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) {
      shown += fmt::format("\\x{:02x}", byte);
    } else {
      shown += c;
    }
  }
  return shown;
}

std::string one_line(const Location& where, const std::string& key, const std::string& message) {
  return printable(
      fmt::format("{}:{}:{}: {}: {}", where.file, where.line, where.column, key, message));
}

}  // namespace

SceneError::SceneError(Location where, std::string key, std::string message)
    : std::runtime_error(one_line(where, key, message)),
      where_(std::move(where)),
      key_(std::move(key)),
      message_(std::move(message)) {}

}  // namespace sonoglide::scene
