/// Calibration: the undriven friction force is learnt before the drive is first used.
#pragma once

#include <array>
#include <cstdint>

#include "firmware/numeric/accumulator.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// Mean of the undriven friction force along the sliding. It begins once the contact has slid
/// through its presliding distance and the sensor has settled. Its sign shows a sensor that is
/// wired backwards.
///
/// The sensor's offset is separated from friction if the calibration allows it. If the sliding goes
/// both ways, friction is half of the difference of the two means. If the contact stands still
/// before the first sliding, it is taken to be unloaded there. Otherwise the offset is taken as 0.
///
/// Forces: base the sensor's full scale.
template <class Scalar>
class LearntFriction {
 public:
  struct Parameters {
    std::uint32_t settle_periods;         ///< samples passed over in each direction
    std::uint32_t average_periods;        ///< samples averaged after them, at least 1
    numeric::Accumulator<Scalar> weight;  ///< 1 / average_periods
    std::uint32_t total_periods;          ///< least length of the calibration

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("settle_periods", self.settle_periods);
      visit("average_periods", self.average_periods);
      visit("weight", self.weight);
      visit("total_periods", self.total_periods);
    }
  };

  explicit LearntFriction(const Parameters& parameters) : parameters_(parameters) {}

  void restart() {
    periods_ = 0;
    slid_ = false;
    tared_ = false;
    known_ = {};
    offset_ = {};
    begin(false);
  }

  bool learning() const { return !known_[direction()] || periods_ < parameters_.total_periods; }

  /// One call for each undriven sample. A sliding that stops or turns before its mean is known
  /// begins anew. Rounding of a mean: half a unit of the accumulator for each sample.
  /// @param slow  the sliding is below the speed floor
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

  /// A reading less the sensor's offset.
  Scalar without_offset(Scalar force) const {
    return force -
           (known_[0] && known_[1] ? numeric::half(forward()) - numeric::half(backward()) : tare());
  }

 private:
  /// Slower than this nothing slides: 2^-15 of the peak vibration velocity at full drive.
  static constexpr Scalar standing() { return numeric::from_real<Scalar>(1.0 / 32768.0); }

  std::size_t direction() const { return backwards_ ? 1 : 0; }
  Scalar forward() const { return numeric::rounded<Scalar>(mean_[0]); }
  Scalar backward() const { return numeric::rounded<Scalar>(mean_[1]); }
  Scalar tare() const { return numeric::rounded<Scalar>(offset_); }

  void begin(bool backwards) {
    backwards_ = backwards;
    if (!known_[direction()]) {
      samples_ = 0;
      mean_[direction()] = {};
    }
  }

  void average(Scalar along) {
    if (samples_ >= parameters_.settle_periods) {
      mean_[direction()] += numeric::accumulate(along) * parameters_.weight;
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
  numeric::Accumulator<Scalar> offset_{};               ///< as tared
  std::array<bool, 2> known_{};
  bool backwards_ = false;
  bool slid_ = false;
  bool tared_ = false;
};

}  // namespace sonoglide::control
