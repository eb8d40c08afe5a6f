/// A board whose carrier periods come from a free-running counter of its own.
#pragma once

#include <cstdint>
#include <utility>

#include "hal/board.hpp"
#include "hal/timed/drive_register.hpp"

namespace sonoglide::hal::timed {

/// A contact of one state. In each carrier period friction moves half of the way towards a value:
/// Fc v / a if the drive's peak velocity a exceeds the sliding velocity v, otherwise Fc. It is no
/// model of friction. The ratio is above that of the Coulomb contact, (2/pi) asin(v / a), by a
/// factor of up to pi/2, which the controller's feedback corrects.
///
/// Fc is half of the sensor's full scale and v a tenth of the peak velocity at full drive, as in
/// scenes that say nothing else and in the Table 1 contact.
class StandInContact {
 public:
  static constexpr std::int32_t undriven_friction = INT32_C(1) << 30;
  static constexpr std::int32_t velocity = INT32_C(0x0ccccccd);

  /// In force from the next live() on.
  /// @param amplitude  code, 0 ... 2^31 - 1.
  void drive(std::int32_t amplitude) { amplitude_ = amplitude; }

  /// One carrier period.
  void live() { friction_ += (settled_friction() - friction_) / 2; }

  Sample sample() const { return {friction_, velocity, false, true}; }

 private:
  /// To 2^-12 of Fc; 32 bits, since the smallest processor divides them fastest.
  std::int32_t settled_friction() const {
    constexpr int fraction_bits = 12;
    if (amplitude_ <= velocity) {
      return undriven_friction;
    }
    const std::int32_t ratio = velocity / ((amplitude_ >> fraction_bits) + 1);
    return ratio * (undriven_friction >> fraction_bits);
  }

  std::int32_t friction_ = undriven_friction;
  std::int32_t amplitude_ = 0;
};

/// Of the loop: controller.every_periods carrier periods, as the scene is designed. An emulated processor
/// is slower than one that one would buy: of a scene with fewer, a period of the loop is
/// Hardware::least_periods carrier periods, and all the rest is as much slower than designed.
template <class Hardware>
constexpr double loop_period_s(double carrier_period_s, unsigned every_periods) {
  return (every_periods < Hardware::least_periods ? Hardware::least_periods : every_periods) *
         carrier_period_s;
}

/// Begins a period of the loop every so many ticks, and takes its samples from a stand-in for the contact,
/// because it has neither converter nor transducer. Periods are counted from the counter's value,
/// so that a period in which nobody waited counts too. A call must come at least once in each turn
/// of the counter.
///
/// @tparam Clock  once constructed, it counts up and wraps; it offers
///   static constexpr std::uint32_t hz;
///   static constexpr std::uint32_t largest;  // 2^n - 1: 0 comes after it
///   std::uint32_t ticks() const;
/// @tparam Contact  has drive(), live() and sample() as StandInContact; that of a unit that observes the
///                  vibration gives its samples
template <class Clock, class Contact = StandInContact>
class Board {
 public:
  static constexpr std::uint32_t clock_hz = Clock::hz;
  static constexpr std::uint32_t most_period_ticks = Clock::largest;

  /// @param period_ticks  of a period of the loop, 1 ... most_period_ticks.
  explicit Board(std::uint32_t period_ticks)
      : period_ticks_(period_ticks), begin_(clock_.ticks()) {}

  using Sample = decltype(std::declval<const Contact&>().sample());

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
  Contact contact_{};
  std::uint32_t period_ticks_;
  std::uint32_t begin_;  ///< of the present period
  std::uint32_t period_ = 0;
  std::uint32_t sampled_ = 0;
};

}  // namespace sonoglide::hal::timed
