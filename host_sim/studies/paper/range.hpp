/// From the least to the most of a quantity.
#pragma once

#include <algorithm>

namespace sonoglide::paper {

struct Range {
  double least;
  double most;
};

inline Range joined(const Range& one, const Range& other) {
  return {std::min(one.least, other.least), std::max(one.most, other.most)};
}

}  // namespace sonoglide::paper
