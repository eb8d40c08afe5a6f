/// How far a long computation is, on a terminal.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdio>
#include <string>

#include "host_sim/process/ending.hpp"

namespace sonoglide::cli {

/// One line without its end: `[########------------]  40 %, 3 s left`; on a narrow terminal with a
/// shorter bar, without the time, and at last without the bar.
///
/// @param fraction   done, clamped to [0, 1]
/// @param elapsed_s  time taken for it
/// @param columns    of the terminal; the line takes one less, which no terminal wraps
std::string progress_line(double fraction, double elapsed_s, int columns = 80);

/// Redraws its line at most ten times a second and clears it when destroyed, or when a signal ends
/// the program. Silent unless the
/// stream is a terminal that can erase a line: one of no name or `dumb` (TERM) cannot.
class ProgressBar {
 public:
  /// @param stream  outlives the bar
  /// @param wanted  false keeps it silent on a terminal too
  ProgressBar(std::FILE* stream, bool wanted);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void update(double fraction);

 private:
  using Clock = std::chrono::steady_clock;

  void erase_at_once() const;

  std::FILE* stream_;
  bool shown_;
  std::atomic<bool> drawn_{false};
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_drawn_ = start_;
  process::Undo erased_;
};

/// What a computation gives that is told how to say how far it is. A signal ends it at once: nothing
/// may have been written yet.
template <class Compute>
auto with_bar(bool quiet, const Compute& compute) {
  ProgressBar bar(stderr, !quiet);
  return compute([&bar](double fraction) { bar.update(fraction); });
}

}  // namespace sonoglide::cli
