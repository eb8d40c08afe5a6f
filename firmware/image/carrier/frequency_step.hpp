/// How finely an image tunes its drive; included after the configuration of its controller, which says so.
#pragma once

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
