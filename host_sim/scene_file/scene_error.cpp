#include "host_sim/scene_file/scene_error.hpp"

#include <fmt/format.h>

#include <utility>

#include "host_sim/process/printable.hpp"

namespace sonoglide::scene_file {
namespace {

std::string one_line(const Location& where, const std::string& key, const std::string& message) {
  return process::printable(
      fmt::format("{}:{}:{}: {}: {}", where.file, where.line, where.column, key, message));
}

}  // namespace

SceneError::SceneError(Location where, std::string key, std::string message)
    : std::runtime_error(one_line(where, key, message)),
      where_(std::move(where)),
      key_(std::move(key)),
      message_(std::move(message)) {}

}  // namespace sonoglide::scene_file
