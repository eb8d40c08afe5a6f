/// Which states of a run are kept.
#pragma once

#include <cstddef>
#include <vector>

#include "host_sim/loop/plant_port.hpp"

namespace sonoglide::loop {

/// States at equally spaced times.
struct Recording {
  std::vector<double> time_s;
  std::vector<PlantState> state;
  std::vector<double> drive_force_N;
  std::vector<double> sliding_velocity_m_per_s;
};

/// Fills recordings from the stretches of a run as they are simulated, in order.
class Recorder {
 public:
  /// Asks for states at begin_s + i·interval_s up to end_s, ends included. `into` must outlive the
  /// recorder.
  void want(double begin_s, double end_s, double interval_s, Recording& into);

  /// Offsets, rising, of the states wanted in [begin_s, end_s), or [begin_s, end_s] in the run's
  /// last stretch; take() expects their states.
  std::vector<double> plan(double begin_s, double end_s, bool last);

  /// Takes the states at the offsets that were last planned.
  void take(double begin_s, const Stretch& stretch, const std::vector<PlantState>& seen);

 private:
  struct Request {
    double begin_s = 0.0;
    double interval_s = 0.0;
    std::size_t count = 0;
    Recording* into = nullptr;
    std::size_t next = 0;

    double next_time_s() const { return begin_s + static_cast<double>(next) * interval_s; }
  };

  struct Planned {
    double offset_s = 0.0;
    Recording* into = nullptr;
  };

  std::vector<Request> requests_;
  std::vector<Planned> planned_;
};

}  // namespace sonoglide::loop
