/// Refuses, when an image is compiled, what a board that makes the carrier in hardware has no time for.
#pragma once

#include <cstdint>
#include <type_traits>

#include "firmware/control/vibration/fed_forward.hpp"

namespace sonoglide::image {

/// Clocks in a carrier period.
///
/// @tparam Parts  of the controller
/// @tparam Board  offers period_ticks(period_s), 0 where it cannot make the period
template <class Parts, class Board>
struct CarrierTicks {
  using Scalar = typename Parts::Scalar;
  static_assert(
      !std::is_floating_point_v<Scalar>,
      "this board has no time for floating point: set controller.arithmetic to q31 or q15");
  static_assert(std::is_same_v<typename Parts::Vibration, control::FedForward<Scalar>>,
                "this board has no time to observe the vibration: leave out controller.vibration");

  /// @param period_s  of the carrier
  static constexpr std::uint32_t of(double period_s) { return Board::period_ticks(period_s); }
};

}  // namespace sonoglide::image
