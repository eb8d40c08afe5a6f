#include "host_sim/scene/number.hpp"

#include <cmath>

namespace sonoglide::scene {

bool is_written_whole(double number) {
  constexpr double largest_plain = 1e16;
  return std::trunc(number) == number && std::abs(number) < largest_plain;
}

Number::Number(double number) : value_(toml::value<double>(number)) {
  if (is_written_whole(number)) {
    value_ = toml::value<std::int64_t>(static_cast<std::int64_t>(number));
  }
}

}  // namespace sonoglide::scene
