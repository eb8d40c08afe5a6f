/// Several vectors of lanes, computed side by side: while one waits for a result, others proceed.
#pragma once

#include <array>
#include <cstddef>

#include "firmware/numeric/lanes.hpp"

namespace sonoglide::numeric {

/// `Count` vectors, with + - * lane by lane. The other operand is a group, or a number or vector
/// that applies to each. The bits are those of one vector after the other.
template <class Float, std::size_t Count>
struct LaneGroup {
  std::array<Lanes<Float>, Count> part;

  [[gnu::always_inline]] LaneGroup& operator*=(const LaneGroup& other) {
    return *this = *this * other;
  }
  [[gnu::always_inline]] friend LaneGroup operator+(LaneGroup a, const LaneGroup& b) {
    for (std::size_t i = 0; i < Count; ++i) {
      a.part[i] = a.part[i] + b.part[i];
    }
    return a;
  }
  [[gnu::always_inline]] friend LaneGroup operator*(LaneGroup a, const LaneGroup& b) {
    for (std::size_t i = 0; i < Count; ++i) {
      a.part[i] = a.part[i] * b.part[i];
    }
    return a;
  }
  template <class Each>
  [[gnu::always_inline]] friend LaneGroup operator+(LaneGroup a, Each each) {
    for (std::size_t i = 0; i < Count; ++i) {
      a.part[i] = a.part[i] + each;
    }
    return a;
  }
  template <class Each>
  [[gnu::always_inline]] friend LaneGroup operator-(LaneGroup a, Each each) {
    for (std::size_t i = 0; i < Count; ++i) {
      a.part[i] = a.part[i] - each;
    }
    return a;
  }
  template <class Each>
  [[gnu::always_inline]] friend LaneGroup operator*(LaneGroup a, Each each) {
    for (std::size_t i = 0; i < Count; ++i) {
      a.part[i] = a.part[i] * each;
    }
    return a;
  }
  template <class Each>
  [[gnu::always_inline]] friend LaneGroup operator+(Each each, LaneGroup a) {
    return a + each;
  }
  template <class Each>
  [[gnu::always_inline]] friend LaneGroup operator*(Each each, LaneGroup a) {
    return a * each;
  }
  template <class Each>
  [[gnu::always_inline]] friend LaneGroup operator-(Each each, LaneGroup a) {
    for (std::size_t i = 0; i < Count; ++i) {
      a.part[i] = each - a.part[i];
    }
    return a;
  }
};

/// `Count` vectors whose numbers lie one after the other, aligned or not.
template <std::size_t Count, class Float>
[[gnu::always_inline]] inline LaneGroup<Float, Count> load_group(const Float* from) {
  LaneGroup<Float, Count> group{};
  for (std::size_t i = 0; i < Count; ++i) {
    group.part[i] = load(from + i * lane_count<Float>);
  }
  return group;
}

/// at_most() of each vector.
template <class Float, std::size_t Count>
[[gnu::always_inline]] inline LaneGroup<Float, Count> at_most(Float limit,
                                                              LaneGroup<Float, Count> x) {
  for (std::size_t i = 0; i < Count; ++i) {
    x.part[i] = at_most<Float>(limit, x.part[i]);
  }
  return x;
}

/// The sum of all numbers: of the vectors first, then of the lanes.
template <class Float, std::size_t Count>
[[gnu::always_inline]] inline Float sum_of_lanes(const LaneGroup<Float, Count>& x) {
  Lanes<Float> sum = x.part[0];
  for (std::size_t i = 1; i < Count; ++i) {
    sum += x.part[i];
  }
  return sum_of_lanes<Float>(sum);
}

}  // namespace sonoglide::numeric
