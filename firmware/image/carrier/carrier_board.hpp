/// What an image asks of a board that makes the carrier in hardware; included after the configuration of the
/// image's controller.
#pragma once

#include <cstdint>
#include <type_traits>

#include "firmware/control/controller.hpp"
#include "firmware/control/interface/drive_command.hpp"
#include "firmware/control/vibration/fed_forward.hpp"

namespace sonoglide::image {

/// The board of an image whose hardware may have an encoder along the sliding, which is in the images of scenes
/// with a texture alone.
///
/// @tparam Hardware  has a Board, and a BoardWithEncoder where it was told of an encoder
/// @tparam Targets   of the scene
template <class Hardware, class Targets, class = void>
struct BoardOf {
  using Type = typename Hardware::Board;
};
template <class Hardware, class Texture>
struct BoardOf<Hardware, Texture,
               std::void_t<typename Hardware::BoardWithEncoder, typename Texture::Length>> {
  using Type = typename Hardware::BoardWithEncoder;
};

/// Clocks in a carrier period. Refuses, when an image is compiled, what such a board has no time for.
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

namespace sonoglide::app {
/// Found where the configuration has no step of its own: the drive keeps its frequency.
inline constexpr double frequency_step_Hz = 0.0;
namespace configuration {
inline constexpr double step_of_drive_Hz = frequency_step_Hz;
}

/// The controller's answers have a frequency.
inline constexpr bool tuned = configuration::step_of_drive_Hz > 0.0;

/// Tells the board what frequency its answers will have.
/// @param carrier_period_s  at the start
template <class Board>
void tune([[maybe_unused]] Board& board, [[maybe_unused]] double carrier_period_s) {
  if constexpr (tuned) {
    board.tune(carrier_period_s, configuration::step_of_drive_Hz);
  }
}

}  // namespace sonoglide::app
