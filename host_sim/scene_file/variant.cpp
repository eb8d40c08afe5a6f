#include "host_sim/scene_file/variant.hpp"

#include <cmath>
#include <utility>

namespace sonoglide::scene_file {

bool is_written_whole(double number) {
  constexpr double largest_plain = 1e16;
  return std::trunc(number) == number && std::abs(number) < largest_plain;
}

VariedValue::VariedValue(double number) : value_(toml::value<double>(number)) {
  if (is_written_whole(number)) {
    value_ = toml::value<std::int64_t>(static_cast<std::int64_t>(number));
  }
}

VariedValue::VariedValue(std::string word) : value_(toml::value<std::string>(std::move(word))) {}

VariedValue::VariedValue(bool truth) : value_(toml::value<bool>(truth)) {}

}  // namespace sonoglide::scene_file
