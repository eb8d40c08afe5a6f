/// A Gauss-Legendre rule as whole lanes.
#pragma once

#include <array>
#include <cstddef>

#include "firmware/numeric/gauss_legendre.hpp"
#include "firmware/numeric/lanes.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::numeric {

/// `Count` nodes on [0, 1] in rising order, and their weights; whole lanes of them.
template <class Float, std::size_t Count>
struct GaussRule {
  static_assert(Count % numeric::lane_count<Float> == 0, "nodes fill lanes");
  static constexpr std::size_t vectors = Count / numeric::lane_count<Float>;

  alignas(16) std::array<Float, Count> node{};
  alignas(16) std::array<Float, Count> weight{};

  constexpr GaussRule() {
    const auto rule = numeric::gauss_legendre<static_cast<int>(Count)>();
    for (std::size_t i = 0; i < Count; ++i) {
      node[i] = numeric::from_real<Float>(rule.node[i]);
      weight[i] = numeric::from_real<Float>(rule.weight[i]);
    }
  }
};

template <class Float, std::size_t Count>
inline constexpr GaussRule<Float, Count> gauss_rule{};

}  // namespace sonoglide::numeric
