#include "host_sim/scene_file/range.hpp"

#include <fmt/format.h>

namespace sonoglide::scene_file {

std::string Range::text() const {
  const std::string bounds = low_open ? fmt::format("above {:g}, at most {:g}", low, high)
                                      : fmt::format("{:g} to {:g}", low, high);
  return unit.empty() ? bounds : fmt::format("{} {}", bounds, unit);
}

}  // namespace sonoglide::scene_file
