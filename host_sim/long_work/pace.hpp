/// Finished points to the part of the time that is gone.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <mutex>

namespace sonoglide::long_work {

/// Called now and then with the part of the time that is gone, in [0, 1], by one thread at a time:
/// time gone × (1 − fraction) / fraction is the time left. It falls where the rest turns out to
/// take longer than it seemed.
using Progress = std::function<void(double fraction)>;

/// Time in s since some beginning.
inline double steady_time_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Follows work done in stages. Within a stage every point is taken to cost the same; points that
/// were finished before do not count, so that work that goes on is not thought fast.
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

}  // namespace sonoglide::long_work
