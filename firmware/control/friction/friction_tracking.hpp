/// Friction force, contact stiffness and gain of the vibration, learnt while the drive is on.
#pragma once

#include <cstdint>

#include "firmware/control/friction/friction_estimate.hpp"
#include "firmware/control/friction/friction_level.hpp"
#include "firmware/control/friction/half_logarithm.hpp"
#include "firmware/control/friction/periodic_relearning.hpp"
#include "firmware/control/interface/part_name.hpp"
#include "firmware/numeric/accumulator.hpp"
#include "firmware/numeric/floating.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// Takes a reading wherever the request has stood still for a while, and weighs it in a
/// FrictionEstimate: the mean force, over that of the map at the request, which is the commanded
/// ratio. A reading is taken in where the request is another than that of the last one, or where it
/// shows that the friction has changed.
///
/// Where Fc is too uncertain, which it is at the start, the request dips once: to `edge` of the
/// sliding speed. There the sliding never reverses, so that the mean force is Fc, whatever contact
/// stiffness and gain are. It dips too where the drive has come to its limit, because the reading
/// then is of no commanded ratio. The controller is in State::relearning meanwhile.
///
/// Periods: the request has to stand for `wait`, and the reading is averaged over `average` more. It
/// is weighed in four steps, one a period; the request then stands for two, in which level, map and
/// integral change. A dip in which no reading is complete within four times as long ends.
///
/// Ratios on base 2. Speeds and requests: base the peak vibration velocity at full drive, or the range
/// of the vibration sensor.
template <class ScalarT>
class FrictionTracking {
 public:
  static constexpr PartName part_name{"friction/friction_tracking", "FrictionTracking"};
  using Scalar = ScalarT;
  using Estimate = FrictionEstimate<Scalar>;

  struct Parameters {
    std::uint16_t wait_periods;
    std::uint8_t average_periods;         ///< >= 1
    numeric::Accumulator<Scalar> weight;  ///< 1/average_periods
    Scalar deviation;                     ///< of a mean force, a quarter of it over Fc
    Scalar certain;  ///< variance of ln Fc up to which the request does not dip
    Scalar edge;     ///< request of a dip, over the nominal one at which the sliding first stops
    typename Estimate::Parameters start;

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("wait_periods", self.wait_periods);
      visit("average_periods", self.average_periods);
      visit("weight", self.weight);
      visit("deviation", self.deviation);
      visit("certain", self.certain);
      visit("edge", self.edge);
      visit("start", self.start);
    }
  };

  explicit FrictionTracking(const Parameters& parameters)
      : parameters_(parameters), estimate_(parameters.start) {
    restart();
  }

  void restart() {
    estimate_.restart();
    contact_ = unity();
    inverse_gain_ = unity();
    taken_at_ = {};
    interrupt();
  }

  /// Ends a dip; where Fc is too uncertain another one begins.
  /// @return true if `adapt` would have been next
  bool interrupt() {
    const bool learnt = phase_ == Phase::adapt;
    begun_ = false;
    dips_ = false;
    phase_ = Phase::watch;
    return learnt;
  }

  bool pausing() const { return dips_; }

  /// Of the drive in a dip. @param speed  of the sliding
  Scalar request(Scalar speed) const {
    return numeric::rough_product(numeric::limited_product(speed, inverse_gain_), parameters_.edge);
  }

  /// One call for each period in which the drive is to hold a ratio.
  template <class Feedforward>
  Task next(const FrictionReading<Scalar>& now, const Feedforward& map) {
    switch (phase_) {
      case Phase::watch:
        watch(now);
        break;
      case Phase::reversal_slope:
        reversal_slope(now.speed, map);
        break;
      case Phase::stiffness_slope:
        stiffness_slope(now.speed, map);
        break;
      case Phase::weigh:
        weigh();
        break;
      case Phase::learn:
        learn();
        return Task::learn;
      case Phase::adapt:
        dip(!dips_ && uncertain());
        begin(now.requested);
        return Task::adapt;
    }
    return dips_ ? Task::pause : Task::regulate;
  }

  /// Fc that follows from the one before.
  Scalar force(Scalar before) const { return numeric::limited_product(before, force_change_); }

  /// The integral keeps what the new map does not explain.
  template <class Regulator>
  void correct(Regulator& regulator, const FrictionChange<Scalar>& change) const {
    if (dips_) {
      regulator.restart(change.target);
    } else {
      const Scalar unexplained = numeric::twice(estimate_.residual());
      regulator.shift(change.target - numeric::rough_product(change.target, unexplained),
                      change.commanded);
    }
  }

  /// Sets a feedforward to what is known of the friction.
  template <class Feedforward>
  void adapt(Feedforward& feedforward, const FrictionLevel<Scalar>& level) const {
    feedforward.set_friction(level, contact_, inverse_gain_);
  }

  /// Variances of ln Fc, ln Kt and ln g.
  const typename Estimate::Each& variance() const { return estimate_.variance(); }
  /// Kt g over the nominal one, and 1/g.
  const numeric::Floating<Scalar>& contact() const { return contact_; }
  const numeric::Floating<Scalar>& inverse_gain() const { return inverse_gain_; }

 private:
  using Floating = numeric::Floating<Scalar>;
  enum class Phase : std::uint8_t { watch, reversal_slope, stiffness_slope, weigh, learn, adapt };

  static constexpr Scalar one_half() { return numeric::from_real<Scalar>(0.5); }
  static Floating unity() { return numeric::rescaled(numeric::floating(one_half()), 1); }

  /// By more than 2^-bits of it.
  static bool differs(Scalar request, Scalar from, int bits) {
    return numeric::scale_by_power_of_two(from, -bits) < numeric::abs(request - from);
  }

  bool uncertain() const { return parameters_.certain < estimate_.variance().force; }

  void dip(bool dips) {
    dips_ = dips;
    dip_periods_ = 0;
  }

  /// The readings begin anew, with the request that stands.
  void begin(Scalar requested) {
    stands_at_ = requested;
    count_ = 0;
    measured_ = {};
    commanded_ = {};
    limited_ = false;
    phase_ = Phase::watch;
  }

  void watch(const FrictionReading<Scalar>& now) {
    if (!begun_) {
      begun_ = true;
      dip(uncertain());
      begin(now.requested);
      return;
    }
    if (differs(now.requested, stands_at_, 4)) {
      begin(now.requested);
    }
    if (dips_) {
      ++dip_periods_;
      dips_ = dip_periods_ < 4U * whole();
    }
    ++count_;
    if (count_ > parameters_.wait_periods) {
      measured_ += numeric::accumulate(now.measured) * parameters_.weight;
      commanded_ += numeric::accumulate(now.commanded) * parameters_.weight;
      limited_ = limited_ || !now.followed;
      if (count_ >= whole()) {
        compare();
      }
    }
  }

  std::uint32_t whole() const {
    return std::uint32_t{parameters_.wait_periods} + parameters_.average_periods;
  }

  /// A reading is complete.
  void compare() {
    wanted_ = dips_ || differs(stands_at_, taken_at_, 6);
    if (limited_ && !dips_) {
      dip(wanted_);
      taken_at_ = stands_at_;
      begin(stands_at_);
      return;
    }
    ratio_ = dips_ ? one_half() : numeric::rounded<Scalar>(commanded_);
    reading_.innovation = half_log(numeric::rounded<Scalar>(measured_), ratio_);
    constexpr Scalar least = numeric::from_real<Scalar>(0x1p-12);
    reading_.deviation =
        numeric::limited_product(parameters_.deviation, inverse_of(numeric::max(ratio_, least)));
    reading_.slope = {one_half(), Scalar{}, Scalar{}};
    phase_ = dips_ ? Phase::weigh : Phase::reversal_slope;
  }

  /// Half of w, from two places of the inverse map.
  template <class Feedforward>
  void reversal_slope(Scalar speed, const Feedforward& map) {
    constexpr Scalar step = numeric::from_real<Scalar>(1.0 / 64.0);
    const bool up = ratio_ < one_half() - step;
    const Scalar beside = up ? ratio_ + step : ratio_ - step;
    amplitude_ = map.amplitude(ratio_, speed);
    const Scalar other = map.amplitude(beside, speed);
    const Scalar change =
        numeric::half_difference(up ? amplitude_ : other, up ? other : amplitude_);
    if (!(Scalar{} < change)) {
      begin(stands_at_);  // both beyond the largest drive
      return;
    }
    const Floating relative = numeric::quotient(
        numeric::floating(numeric::half_sum(amplitude_, other)), numeric::floating(change));
    const Floating per_ratio =
        numeric::quotient(numeric::floating(numeric::half(step)),
                          numeric::floating(numeric::half_sum(ratio_, beside)));
    reading_.slope.gain =
        -numeric::limited_product(one_half(), numeric::product(relative, per_ratio));
    phase_ = Phase::stiffness_slope;
  }

  /// Half of s, from the inverse map of a stiffer contact.
  template <class Feedforward>
  void stiffness_slope(Scalar speed, const Feedforward& map) {
    const Scalar stiffer = map.stiffer_amplitude(ratio_, speed);
    const Scalar change = numeric::max(Scalar{}, numeric::half_difference(amplitude_, stiffer));
    constexpr double per_log = 2.0 / 0.22314355131420976;  // ln 1.25
    constexpr Scalar factor = numeric::from_real<Scalar>(per_log / 16.0);
    const Scalar part = numeric::limited_product(
        change, numeric::rescaled(inverse_of(numeric::half_sum(amplitude_, stiffer)), 4));
    reading_.slope.stiffness =
        numeric::rough_product(reading_.slope.gain, numeric::rough_product(factor, part));
    reading_.slope.force = one_half() - reading_.slope.stiffness;
    phase_ = Phase::weigh;
  }

  void weigh() {
    if (estimate_.weigh(reading_, wanted_)) {
      phase_ = Phase::learn;
    } else {
      begin(stands_at_);
    }
  }

  void learn() {
    const typename Estimate::Each moved = estimate_.take();
    force_change_ = exponential_of_twice(moved.force);
    contact_ = numeric::product(numeric::product(contact_, exponential_of_twice(moved.stiffness)),
                                exponential_of_twice(moved.gain));
    inverse_gain_ = numeric::product(inverse_gain_, exponential_of_twice(-moved.gain));
    if (!dips_) {  // the request before a dip asks for no other one
      taken_at_ = stands_at_;
    }
    phase_ = Phase::adapt;
  }

  Parameters parameters_;
  Estimate estimate_;
  Floating contact_{};
  Floating inverse_gain_{};
  Floating force_change_{};
  typename Estimate::Reading reading_{};
  Scalar stands_at_{};  ///< request, within a sixteenth
  Scalar taken_at_{};   ///< that of the last reading taken in
  Scalar ratio_{};
  Scalar amplitude_{};
  numeric::Accumulator<Scalar> measured_{};
  numeric::Accumulator<Scalar> commanded_{};
  std::uint32_t count_ = 0;
  std::uint32_t dip_periods_ = 0;
  Phase phase_ = Phase::watch;
  bool begun_ = false;
  bool dips_ = false;
  bool wanted_ = false;
  bool limited_ = false;
};

}  // namespace sonoglide::control
