/// Which states of a run are wanted when.
#pragma once

#include <cstdint>
#include <vector>

#include "host_sim/loop/watch.hpp"

namespace sonoglide::loop {

/// Serves samplings from the stretches of a run as they are simulated, in order.
class Sampler {
 public:
  /// @param has_load  the sliding velocity is a part of the state
  explicit Sampler(const std::vector<Sampling>& wanted, bool has_load = false);

  /// False where nothing is wanted before end_s: plan() and deliver() may be left out then.
  bool wants_before(double end_s) const { return next_s_ < end_s; }

  /// Offsets, rising, of the states wanted in [begin_s, end_s), or [begin_s, end_s] in the run's
  /// last stretch; valid until the next call.
  const std::vector<double>& plan(double begin_s, double end_s, bool last);

  /// Hands on the states at the offsets that were last planned.
  /// @param pulled_m  what the far end of a load's spring has moved before the stretch
  void deliver(double begin_s, const Stretch& stretch, const std::vector<PlantState>& seen,
               double pulled_m = 0.0) const;

 private:
  struct Request {
    SampleGrid grid{};
    std::uint64_t count = 0;
    SampleSink* sink = nullptr;
    std::uint64_t next = 0;

    double next_time_s() const {
      return grid.begin_s + static_cast<double>(next) * grid.interval_s;
    }
  };

  struct Planned {
    double offset_s;
    SampleSink* sink;
  };

  void foresee();

  bool has_load_;
  std::vector<Request> requests_;
  std::vector<Planned> planned_;
  std::vector<double> offsets_s_;
  double next_s_ = 0.0;  ///< no sample is wanted before; infinity when all are taken
};

}  // namespace sonoglide::loop
