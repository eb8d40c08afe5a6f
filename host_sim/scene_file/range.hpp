/// What a number in a scene may be.
#pragma once

#include <string>
#include <string_view>

namespace sonoglide::scene_file {

/// From low to high, both allowed unless low_open; in text `1e-12 to 1e+06 kg`.
struct Range {
  double low;
  double high;
  std::string_view unit = "";
  bool low_open = false;

  /// False for NaN.
  bool contains(double value) const {
    return (low_open ? value > low : value >= low) && value <= high;
  }
  std::string text() const;
};

}  // namespace sonoglide::scene_file
