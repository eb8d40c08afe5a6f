/// Calibration: the undriven friction force is learnt before the drive is first used.
#pragma once

#include <array>
#include <cstdint>

#include "firmware/control/interface/part_name.hpp"
#include "firmware/numeric/accumulator.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// No calibration: the configured friction force is trusted.
template <class Scalar>
class TrustedFriction {
 public:
  static constexpr PartName part_name{"friction/learnt_friction", "TrustedFriction"};
  struct Parameters {};

  explicit TrustedFriction(const Parameters&) {}
  void restart() {}
  static constexpr bool learning() { return false; }
  void learn(Scalar, Scalar, bool) {}
  Scalar friction_force(Scalar configured) const { return configured; }
  auto believed(const Scalar& configured) const {
    return [&configured] { return configured; };
  }
  Scalar without_offset(Scalar force) const { return force; }
};

/// Mean of the undriven friction force along the sliding. It begins once the contact has slid
/// through its presliding distance and the sensor has settled. Its sign shows a sensor that is
/// wired backwards.
///
/// A mass that rings faster than the sliding makes the friction of a period smaller, and of each period
/// by another part. So where the readings differ by more than twice `half_steady`, the largest one is
/// taken for the mean.
///
/// The sensor's offset is separated from friction if the calibration allows it. If the sliding goes
/// both ways, friction is half of the difference of the two means. If the contact stands still
/// before the first sliding, it is taken to be unloaded there. Otherwise the offset is taken as 0.
///
/// Forces: base the sensor's full scale.
template <class Scalar>
class LearntFriction {
 public:
  static constexpr PartName part_name{"friction/learnt_friction", "LearntFriction"};
  struct Parameters {
    std::uint32_t settle_periods;         ///< samples passed over in each direction
    std::uint32_t average_periods;        ///< samples averaged after them, at least 1
    numeric::Accumulator<Scalar> weight;  ///< 1 / average_periods
    std::uint32_t total_periods;          ///< least length of the calibration
    Scalar half_steady;                   ///< half the largest difference of readings at rest

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("settle_periods", self.settle_periods);
      visit("average_periods", self.average_periods);
      visit("weight", self.weight);
      visit("total_periods", self.total_periods);
      visit("half_steady", self.half_steady);
    }
  };

  explicit LearntFriction(const Parameters& parameters) : parameters_(parameters) {}

  void restart() {
    periods_ = 0;
    slid_ = false;
    tared_ = false;
    known_ = {};
    range_ = {};
    offset_ = {};
    begin(false);
  }

  bool learning() const { return !known_[direction()] || periods_ < parameters_.total_periods; }

  /// One call for each undriven sample. A sliding that stops or turns before its mean is known
  /// begins anew. Rounding of a mean: half a unit of the accumulator for each sample.
  /// @param force     friction force of the sample
  /// @param velocity  sliding velocity of the sample
  /// @param slow      the sliding is below the speed floor
  void learn(Scalar force, Scalar velocity, bool slow) {
    periods_ += periods_ < UINT32_MAX ? 1U : 0U;
    if (slow) {
      begin(backwards_);
      if (!slid_ && numeric::abs(velocity) < standing()) {
        tare(force);
      }
      return;
    }
    slid_ = true;
    const bool backwards = velocity < Scalar{};
    if (backwards != backwards_) {
      begin(backwards);
    }
    if (!known_[direction()]) {
      average(backwards ? -force : force);
    }
  }

  /// Fc after learning(); negative if friction seems to pull.
  Scalar friction_force(Scalar /*configured*/) const {
    return known_[0] && known_[1] ? numeric::half(forward()) + numeric::half(backward())
                                  : (backwards_ ? backward() + tare() : forward() - tare());
  }

  /// Tells Fc where it is asked for: while it is learnt the configured one.
  auto believed(const Scalar& configured) const {
    return [this, &configured] { return learning() ? configured : friction_force(configured); };
  }

  /// A reading less the sensor's offset.
  Scalar without_offset(Scalar force) const {
    return force -
           (known_[0] && known_[1] ? numeric::half(forward()) - numeric::half(backward()) : tare());
  }

 private:
  /// Slower than this nothing slides: 2^-15 of the peak vibration velocity at full drive.
  static constexpr Scalar standing() { return numeric::from_real<Scalar>(1.0 / 32768.0); }

  /// Of the readings averaged in a direction; none yet: the smallest is above the largest.
  struct Range {
    Scalar smallest = numeric::from_code<Scalar>(INT32_MAX);
    Scalar largest = -numeric::from_code<Scalar>(INT32_MAX);
  };

  std::size_t direction() const { return backwards_ ? 1 : 0; }
  Scalar forward() const { return friction_of(0); }
  Scalar backward() const { return friction_of(1); }
  Scalar friction_of(std::size_t direction) const {
    const Range& range = range_[direction];
    return parameters_.half_steady < numeric::half_difference(range.largest, range.smallest)
               ? range.largest
               : numeric::rounded<Scalar>(mean_[direction]);
  }
  Scalar tare() const { return numeric::rounded<Scalar>(offset_); }

  void begin(bool backwards) {
    backwards_ = backwards;
    if (!known_[direction()]) {
      samples_ = 0;
      mean_[direction()] = {};
      range_[direction()] = {};
    }
  }

  void average(Scalar along) {
    if (samples_ >= parameters_.settle_periods) {
      mean_[direction()] += numeric::accumulate(along) * parameters_.weight;
      Range& range = range_[direction()];
      range.smallest = numeric::min(range.smallest, along);
      range.largest = numeric::max(range.largest, along);
    }
    ++samples_;
    known_[direction()] = samples_ >= parameters_.settle_periods + parameters_.average_periods;
  }

  /// A low-pass of 16 samples.
  void tare(Scalar force) {
    const numeric::Accumulator<Scalar> reading = numeric::accumulate(force);
    offset_ = tared_ ? offset_ + numeric::scale_by_power_of_two(reading, -4) -
                           numeric::scale_by_power_of_two(offset_, -4)
                     : reading;
    tared_ = true;
  }

  Parameters parameters_;
  std::uint32_t periods_ = 0;
  std::uint32_t samples_ = 0;
  std::array<numeric::Accumulator<Scalar>, 2> mean_{};  ///< sliding forwards, backwards
  std::array<Range, 2> range_{};
  numeric::Accumulator<Scalar> offset_{};  ///< as tared
  std::array<bool, 2> known_{};
  bool backwards_ = false;
  bool slid_ = false;
  bool tared_ = false;
};

}  // namespace sonoglide::control
