/// The loop that an image runs: sample, step, drive.
#pragma once

#include "firmware/control/measurement.hpp"
#include "firmware/numeric/scalar.hpp"
#include "hal/board.hpp"

namespace sonoglide::app {

/// Joins a controller to a board. The same code runs in an image and in the simulation.
template <class ControllerT, class BoardT>
class ControlLoop {
 public:
  using Scalar = typename ControllerT::Scalar;

  ControlLoop(ControllerT& controller, BoardT& board) : controller_(controller), board_(board) {}

  /// Serves one carrier period; false when the board shuts down.
  bool serve() {
    hal::Sample sample{};
    if (!board_.sample(sample)) {
      return false;
    }
    const auto command = controller_.step(measurement(sample));
    board_.drive({numeric::to_code(command.amplitude), static_cast<std::uint8_t>(command.state),
                  static_cast<std::uint8_t>(command.limit),
                  static_cast<std::uint8_t>(command.fault)});
    return true;
  }

 private:
  static control::Measurement<Scalar> measurement(const hal::Sample& sample) {
    control::Quality quality = control::Quality::good;
    if (!sample.fresh) {
      quality = control::Quality::missing;
    } else if (sample.force_at_rail) {
      quality = control::Quality::saturated;
    }
    return {numeric::from_code<Scalar>(sample.friction_force),
            numeric::from_code<Scalar>(sample.sliding_velocity), quality};
  }

  ControllerT& controller_;
  BoardT& board_;
};

}  // namespace sonoglide::app
