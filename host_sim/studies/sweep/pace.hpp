/// Finished points to the part of the time that is gone.
#pragma once

#include <cstddef>
#include <functional>
#include <mutex>

#include "host_sim/studies/sweep/progress.hpp"
#include "host_sim/studies/sweep/steady_time.hpp"

namespace sonoglide::sweep {

/// Follows work done in stages. Within a stage every point is taken to cost the same; points that
/// were finished before do not count, so that a sweep that goes on is not thought a fast one.
class Pace {
 public:
  /// Begins to take the time.
  /// @param progress  outlives this; may be empty
  /// @param now_s     the clock
  explicit Pace(const Progress& progress, std::function<double()> now_s = steady_time_s);

  /// Begins a stage; no other is under way.
  /// @param later  expected duration of all later stages over that of this one
  void begin(std::size_t points, double later);

  /// These many points more are done. Safe to call from several threads.
  void add(std::size_t points);

 private:
  const Progress& progress_;
  std::function<double()> now_s_;
  double start_s_;
  double stage_start_s_;
  double later_ = 0.0;
  std::size_t points_ = 0;
  std::size_t done_ = 0;
  std::mutex mutex_;
};

}  // namespace sonoglide::sweep
