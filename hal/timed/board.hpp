/// A board whose carrier periods come from a free-running counter of its own.
#pragma once

#include <cstdint>

#include "hal/board.hpp"
#include "hal/timed/drive_register.hpp"
#include "hal/timed/stand_in_contact.hpp"

namespace sonoglide::hal::timed {

/// Begins a carrier period every so many ticks, and takes its samples from a StandInContact,
/// because it has neither converter nor transducer. Periods are counted from the counter's value,
/// so that a period in which nobody waited counts too. A call must come at least once in each turn
/// of the counter.
///
/// @tparam Clock  once constructed, it counts up and wraps; it offers
///   static constexpr std::uint32_t hz;
///   static constexpr std::uint32_t largest;  // 2^n - 1: 0 comes after it
///   std::uint32_t ticks() const;
template <class Clock>
class Board {
 public:
  static constexpr std::uint32_t clock_hz = Clock::hz;
  static constexpr std::uint32_t most_period_ticks = Clock::largest;

  /// @param period_ticks  of a carrier period, 1 ... most_period_ticks.
  explicit Board(std::uint32_t period_ticks)
      : period_ticks_(period_ticks), begin_(clock_.ticks()) {}

  bool sample(Sample& sample) {
    while (period() == sampled_) {
    }
    sampled_ = period_;
    sample = contact_.sample();
    return true;
  }

  void drive(const Drive& drive) { drive_amplitude = drive.amplitude; }

  std::uint32_t period() {
    while (((clock_.ticks() - begin_) & Clock::largest) >= period_ticks_) {
      begin_ += period_ticks_;
      ++period_;
      contact_.drive(drive_amplitude);
      contact_.live();
    }
    return period_;
  }

 private:
  Clock clock_{};
  StandInContact contact_{};
  std::uint32_t period_ticks_;
  std::uint32_t begin_;  ///< of the present period
  std::uint32_t period_ = 0;
  std::uint32_t sampled_ = 0;
};

}  // namespace sonoglide::hal::timed
