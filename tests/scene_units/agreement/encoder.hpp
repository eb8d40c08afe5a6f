/// A board with an encoder along the sliding of a simulated plant, and the loop that an image runs on it.
#pragma once

#include <cmath>
#include <cstdint>
#include <utility>

#include "firmware/app/control_loop.hpp"
#include "firmware/app/texture.hpp"
#include "firmware/control/controller.hpp"
#include "hal/host/simulated_board.hpp"
#include "host_sim/loop/watch.hpp"
#include "tests/scene_units/agreement/ports.hpp"

namespace sonoglide::app::scene_units_test {

/// Counts the true distance to the end of each carrier period; watches the run.
///
/// @tparam counts_per_m  its resolution
template <std::int64_t counts_per_m>
class Encoder : public loop::PeriodSink {
 public:
  static constexpr auto travel_counts_per_m = static_cast<double>(counts_per_m);

  /// @param first  count where the run begins
  explicit Encoder(std::int64_t first = 0) : first_(first), count_(first) {}

  void take(const loop::Period& period) override {
    count_ =
        first_ + static_cast<std::int64_t>(std::floor(period.end_distance_m * travel_counts_per_m));
  }
  std::uint32_t travel() const { return static_cast<std::uint32_t>(count_); }

 private:
  std::int64_t first_;
  std::int64_t count_;
};

/// The board of a simulation, with an encoder.
template <class Sample, class Drive, class Encoder>
class EncoderBoard : public hal::host::SimulatedBoard<Sample, Drive>, public Encoder {
 public:
  explicit EncoderBoard(const Encoder& encoder) : Encoder(encoder) {}
};

/// The controller and the texture of an image without a host.
///
/// @tparam Encoder  of its board
template <class Parts, class Targets, class Encoder>
class ImagePort : public PortOfParts<Parts> {
  using Base = PortOfParts<Parts>;
  using Controller = control::Controller<Parts>;
  using Board = EncoderBoard<typename Base::Sample, typename Base::Drive, Encoder>;

 public:
  ImagePort(const typename Controller::Parameters& parameters, const Targets& targets,
            const Encoder& encoder)
      : controller_(parameters), schedule_(schedule_of<Board>(targets)), board(encoder) {
    controller_.start();
  }

  void set_target(double /*target*/) override {}

 private:
  typename Base::Drive answer(const typename Base::Sample& sample) override {
    schedule_.advance(controller_);
    board.post(sample);
    ControlLoop<Controller, Board>(controller_, board).serve(schedule_);
    return board.latest_drive();
  }

  Controller controller_;
  decltype(schedule_of<Board>(std::declval<const Targets&>())) schedule_;

 public:
  Board board;
};

}  // namespace sonoglide::app::scene_units_test
