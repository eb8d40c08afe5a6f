/// The points of a sweep: every combination of the values of its keys.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "host_sim/studies/sweep/axis.hpp"

namespace sonoglide::sweep {

/// Cartesian product; the first axis changes slowest.
class Grid {
 public:
  /// @throws scene::SceneError  no axis, or more than most_points points
  explicit Grid(std::vector<Axis> axes);

  const std::vector<Axis>& axes() const { return axes_; }
  std::size_t size() const { return size_; }

  /// Points from one value of an axis to the next.
  std::size_t stride(std::size_t axis) const { return strides_[axis]; }
  /// Position along an axis of a point, in [0, count of that axis).
  std::size_t index(std::size_t point, std::size_t axis) const {
    return point / strides_[axis] % axes_[axis].count;
  }
  double number(std::size_t point, std::size_t axis) const {
    return axes_[axis].number(index(point, axis));
  }
  std::string text(std::size_t point, std::size_t axis) const {
    return axes_[axis].text(index(point, axis));
  }

 private:
  std::vector<Axis> axes_;
  std::vector<std::size_t> strides_;
  std::size_t size_ = 1;
};

}  // namespace sonoglide::sweep
