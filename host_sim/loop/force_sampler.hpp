/// The friction force as a converter sees it that samples it within the carrier period.
#pragma once

#include <vector>

#include "host_sim/loop/plant/energy.hpp"
#include "host_sim/loop/plant/snapshot.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

/// N samples a carrier period, the last at its end, behind a low-pass τ q' = f − q of first order.
///
/// The plant is advanced in equal intervals, of which the mean force is exact; the filter takes each
/// as constant. A jump J inside an interval h then errs by at most J h²/(8 τ²), for a fraction of τ:
/// with at least 64 intervals a carrier period and 10 a τ, at most 0.0013 J. There are 8192 at most:
/// behind a filter of no time a sample is the mean over that part of a period. Without a filter a
/// sample is the force of its moment.
class ForceSampler {
 public:
  explicit ForceSampler(const scene::Scene& scene);

  /// In a carrier period; 1 where the force is not sampled.
  int intervals() const { return intervals_; }

  void begin_period();
  /// One interval is over.
  /// @param so_far   of the carrier period
  /// @param force_N  now
  void take(const EnergyBalance& so_far, double force_N);

  /// Of the carrier period so far; none where the force is not sampled.
  const std::vector<double>& samples_N() const { return samples_N_; }

  void copy_state(StateCopy& copy) { copy(filtered_N_); }

 private:
  int intervals_ = 1;
  int intervals_per_sample_ = 0;  ///< 0: not sampled
  int passed_ = 0;                ///< since the last sample
  double filter_rad_per_s_ = 0.0;
  double filtered_N_ = 0.0;
  double impulse_N_s_ = 0.0;  ///< of the carrier period until the interval
  double passed_s_ = 0.0;     ///< likewise
  std::vector<double> samples_N_;
};

}  // namespace sonoglide::loop
