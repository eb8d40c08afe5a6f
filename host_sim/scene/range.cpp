#include "host_sim/scene/range.hpp"

#include <fmt/format.h>

namespace sonoglide::scene {

std::string Range::text() const {
  const std::string bounds = low_open ? fmt::format("above {:g}, at most {:g}", low, high)
                                      : fmt::format("{:g} to {:g}", low, high);
  return unit.empty() ? bounds : fmt::format("{} {}", bounds, unit);
}

}  // namespace sonoglide::scene
