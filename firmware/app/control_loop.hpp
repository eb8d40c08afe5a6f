/// The loop that an image runs: sample, step, drive.
#pragma once

#include "firmware/app/exchange.hpp"
#include "hal/board.hpp"

namespace sonoglide::app {

/// Joins a controller to a board. The same code runs in an image and in the simulation.
template <class ControllerT, class BoardT>
class ControlLoop {
  using Sample = SampleOf<ControllerT>;
  using Drive = DriveOf<ControllerT>;
  static_assert(hal::is_board<BoardT, Sample, Drive>,
                "a board has sample() and drive(): see hal/board.hpp");

 public:
  using Scalar = typename ControllerT::Scalar;

  ControlLoop(ControllerT& controller, BoardT& board) : controller_(controller), board_(board) {}

  /// Serves one carrier period; false when the board shuts down.
  bool serve() {
    NoTargets none;
    return serve(none);
  }

  /// The same with a schedule of targets, which takes the sample once it is answered.
  template <class Targets>
  bool serve(Targets& targets) {
    Sample sample{};
    if (!board_.sample(sample)) {
      return false;
    }
    board_.drive(drive_of(
        controller_.template step<control::Numbers::finite>(measurement_of<Scalar>(sample))));
    targets.pass(sample, board_);
    return true;
  }

 private:
  struct NoTargets {
    static constexpr void pass(const Sample& /*sample*/, BoardT& /*board*/) {}
  };

  ControllerT& controller_;
  BoardT& board_;
};

}  // namespace sonoglide::app
