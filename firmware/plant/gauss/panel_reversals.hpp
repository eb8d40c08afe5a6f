/// The reversals of the sliding velocity over a panel of time, from values on a grid.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/numeric/lanes.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/plant/gauss/panel_motions.hpp"

namespace sonoglide::plant {

/// Places in x where V changes sign, accurate enough for GaussPanel::turn() to correct the rest.
template <class Scalar>
struct PanelReversals {
  static constexpr std::size_t most = 4;

  std::array<Scalar, most> at{};
  std::size_t count = 0;
  Scalar direction = Scalar(0);  ///< sgn V at the beginning
};

/// V on the grid of a panel. Between two points V differs from a straight line by less than
/// spacing^2 / 8 max|V"|, and V' by less than spacing^2 / 8 max|V"'|. With these bounds and that of
/// friction's share, the grid shows where V keeps its sign, or is monotone and has at most one
/// root.
template <class Scalar>
class GridVelocity {
 public:
  using Lanes = numeric::Lanes<Scalar>;
  using Bits = numeric::LaneBits<Scalar>;
  static constexpr std::size_t width = numeric::lane_count<Scalar>;
  static constexpr std::size_t vectors = (PanelGrid::points + width - 1) / width;

  std::array<Lanes, vectors> velocity{};

  /// Returns false if the grid does not show which way V goes and how often it turns.
  /// slope(g): V' on the grid. velocity_margin, slope_margin: what V and V' on the grid may differ
  /// from the truth between its points.
  template <class Slope>
  [[gnu::always_inline]] bool find(Scalar velocity_margin, Scalar slope_margin, const Slope& slope,
                                   PanelReversals<Scalar>& found) const {
    const auto [small, negative] = marks(velocity_margin);
    constexpr std::uint32_t ends = 1U | (1U << PanelGrid::intervals);
    if ((small & ends) != 0) {
      return false;
    }
    found.direction = (negative & 1U) != 0 ? Scalar(-1) : Scalar(1);
    constexpr std::uint32_t intervals = (1U << PanelGrid::intervals) - 1U;
    const std::uint32_t turns = (negative ^ (negative >> 1U)) & intervals;
    std::uint32_t open = (small | (small >> 1U) | turns) & intervals;
    while (open != 0) {
      const auto g = static_cast<std::size_t>(__builtin_ctz(open));
      const Scalar begin = slope(g);
      const Scalar end = slope(g + 1);
      const Scalar least = numeric::min(numeric::abs(begin), numeric::abs(end));
      if (!(begin * end > Scalar(0)) || !(least > slope_margin)) {
        return false;
      }
      if (((turns >> g) & 1U) != 0) {
        if (found.count == PanelReversals<Scalar>::most) {
          return false;
        }
        add_root(g, begin, end, found);
      }
      open &= open - 1;
    }
    return true;
  }

 private:
  struct Marks {
    std::uint32_t small;     ///< bit g: |V| < margin at point g
    std::uint32_t negative;  ///< bit g: V < 0
  };

  /// A vector at a time: each lane collects the bits of its own points.
  Marks marks(Scalar margin) const {
    const Scalar square = margin * margin;
    Bits small{};
    Bits negative{};
    for (std::size_t v = 0; v < vectors; ++v) {
      small |= numeric::is_negative<Scalar>(velocity[v] * velocity[v] - square) << (v * width);
      negative |= numeric::is_negative<Scalar>(velocity[v]) << (v * width);
    }
    return {in_order(small), in_order(negative)};
  }
  static std::uint32_t in_order(Bits bits) {
    std::uint32_t together = 0;
    for (std::size_t lane = 0; lane < width; ++lane) {
      together |= static_cast<std::uint32_t>(bits[lane]) << lane;
    }
    return together;
  }

  Scalar at(std::size_t g) const { return velocity[g / width][g % width]; }

  /// The root of the cubic with these values and slopes: an estimate from the inverse cubic, then
  /// one step of Newton's method.
  void add_root(std::size_t g, Scalar begin_slope, Scalar end_slope,
                PanelReversals<Scalar>& found) const {
    constexpr Scalar spacing = Scalar(2) / static_cast<Scalar>(PanelGrid::intervals);
    const Scalar value = at(g);
    const Scalar rise = at(g + 1) - value;
    const Scalar first = spacing * begin_slope;
    const Scalar last = spacing * end_slope;
    const Scalar second = Scalar(3) * rise - (numeric::twice(first) + last);
    const Scalar third = (first + last) - numeric::twice(rise);
    const Scalar p = -value / rise;
    const Scalar rest = Scalar(1) - p;
    // x(V) begins with slope rise / first and ends with rise / last, in units of both.
    const Scalar inverse = p * (p * (Scalar(3) - numeric::twice(p)) +
                                rest * (rest * (rise / first) - p * (rise / last)));
    const Scalar x = numeric::clamp(inverse, Scalar(0), Scalar(1));
    const Scalar slope = first + x * (numeric::twice(second) + Scalar(3) * x * third);
    const Scalar error = value + x * (first + x * (second + x * third));
    const Scalar root = x - error / slope;
    found.at[found.count] = (spacing * static_cast<Scalar>(g) - Scalar(1)) + spacing * root;
    ++found.count;
  }
};

}  // namespace sonoglide::plant
