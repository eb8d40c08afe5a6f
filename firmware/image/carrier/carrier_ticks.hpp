/// Refuses, when an image is compiled, what a board that makes the carrier in hardware has no time for.
#pragma once

#include <cstdint>
#include <type_traits>

#include "firmware/control/controller.hpp"
#include "firmware/control/interface/drive_command.hpp"
#include "firmware/control/vibration/fed_forward.hpp"

namespace sonoglide::image {

/// Clocks in a carrier period.
///
/// @tparam Parts          of the controller
/// @tparam Board          says what it has time and sensors for, and offers period_ticks(period_s), 0 where it
///                        cannot make the period; nearest_period_ticks(period_s) too if its drive can be tuned
/// @tparam every_periods  as the written header has it, and the next two
/// @tparam tuned          the controller's answers have a frequency
template <class Parts, class Board, unsigned every_periods, int delay_periods, bool interpolates,
          bool tuned>
struct CarrierTicks {
  static_assert(every_periods == 1,
                "this board steps in each carrier period: leave out controller.every_periods");
  static_assert(delay_periods == 1,
                "this board answers in the carrier period after the sampled one: set "
                "drive.delay_periods to 1");
  static_assert(!interpolates,
                "this board holds the amplitude over a carrier period: leave out "
                "drive.interpolation");
  using Scalar = typename Parts::Scalar;
  static_assert(
      Board::computes_floating_point || !std::is_floating_point_v<Scalar>,
      "this board has no time for floating point: set controller.arithmetic to q31 or q15");
  static_assert(Board::observes_vibration ||
                    std::is_same_v<typename Parts::Vibration, control::FedForward<Scalar>>,
                "this board has no time to observe the vibration: leave out controller.vibration");
  static_assert(Board::has_vibration_sensor || !Parts::Vibration::observed,
                "this board has no vibration sensor: leave out sensor.vibration");
  static_assert(
      !std::is_same_v<typename control::Controller<Parts>::Command, control::BiasedCommand<Scalar>>,
      "this board has no output for a bias: leave out drive.bias_limit_N");

  /// @param period_s  of the carrier
  static constexpr std::uint32_t of(double period_s) {
    if constexpr (tuned) {
      return Board::nearest_period_ticks(period_s);
    } else {
      return Board::period_ticks(period_s);
    }
  }
};

}  // namespace sonoglide::image
