#include "host_sim/studies/sweep/grid.hpp"

#include <fmt/format.h>

#include <utility>

#include "host_sim/scene_file/scene_error.hpp"

namespace sonoglide::sweep {
namespace {

[[noreturn]] void fail(std::size_t axis, const std::string& key, const std::string& message) {
  throw scene_file::SceneError({"--vary", axis + 1, 1}, key, message);
}

}  // namespace

Grid::Grid(std::vector<Axis> axes) : axes_(std::move(axes)), strides_(axes_.size()) {
  if (axes_.empty()) {
    fail(0, "--vary", "nothing is varied; allowed: at least one --vary");
  }
  for (std::size_t axis = axes_.size(); axis-- > 0;) {
    strides_[axis] = size_;
    size_ *= axes_[axis].count;
    if (size_ > most_points) {
      fail(axis, axes_[axis].key,
           fmt::format("more than {0} points in all; allowed: at most {0}", most_points));
    }
  }
}

}  // namespace sonoglide::sweep
