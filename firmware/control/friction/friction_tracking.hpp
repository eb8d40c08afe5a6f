/// Friction force, contact stiffness and gain of the vibration, learnt while the drive is on.
#pragma once

#include <cstdint>

#include "firmware/control/friction/friction_drift.hpp"
#include "firmware/control/friction/friction_estimate.hpp"
#include "firmware/control/friction/friction_level.hpp"
#include "firmware/control/friction/half_logarithm.hpp"
#include "firmware/control/friction/map_slopes.hpp"
#include "firmware/control/friction/periodic_relearning.hpp"
#include "firmware/control/friction/steady_mean.hpp"
#include "firmware/control/interface/part_name.hpp"
#include "firmware/numeric/floating.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// Takes readings (SteadyMean) wherever the request stands still: the mean force, over that of the map at
/// the request, which is the commanded ratio. The first one at a request is weighed in a FrictionEstimate.
/// Those that follow it there move Fc by what they show beyond the first one (FrictionDrift): the error
/// of the map, of at most two deviations, is the same in all of them. One that shows far more is weighed
/// again, as a friction that has jumped.
///
/// Where Fc is too uncertain, which it is at the start, the request dips once: to `edge` of the
/// sliding speed. There the sliding never reverses, so that the mean force is Fc, whatever contact
/// stiffness and gain are. It dips too where the drive has come to its limit, because the reading
/// then is of no commanded ratio. The controller is in State::relearning meanwhile.
///
/// A reading is weighed in five steps, one a period, or moves Fc in one; the request then stands for two,
/// in which level, map and integral change. A dip whose reading moves Fc by more than half has another
/// one. A dip in which no reading is complete within dip_periods ends.
///
/// A friction that drifts moves between the dip and the first reading after it as well, which takes that
/// for an error of Kt and g. Four readings later the drift is known: where it shows, by more than four
/// times their noise, all is forgotten and learnt again, once, in a dip after which Fc is moved by the
/// drift up to the first reading. Fc is less certain by what four readings show in any case.
///
/// Ratios on base 2. Speeds and requests: base the peak vibration velocity at full drive.
template <class ScalarT>
class FrictionTracking {
 public:
  static constexpr PartName part_name{"friction/friction_tracking", "FrictionTracking"};
  using Scalar = ScalarT;
  using Estimate = FrictionEstimate<Scalar>;

  struct Parameters {
    typename SteadyMean<Scalar>::Parameters mean;
    Scalar deviation;           ///< of a mean force, a quarter of it over Fc
    Scalar noise;               ///< the part of it that is another in each reading, likewise
    Scalar certain;             ///< variance of ln Fc up to which the request does not dip
    std::uint16_t dip_periods;  ///< after which a dip ends that has no reading
    Scalar edge;  ///< request of a dip, over the nominal one at which the sliding first stops
    typename Estimate::Parameters start;

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("mean", self.mean);
      visit("deviation", self.deviation);
      visit("noise", self.noise);
      visit("certain", self.certain);
      visit("dip_periods", self.dip_periods);
      visit("edge", self.edge);
      visit("start", self.start);
    }
  };

  explicit FrictionTracking(const Parameters& parameters)
      : parameters_(parameters), mean_(parameters.mean), estimate_(parameters.start) {
    restart();
  }

  void restart() {
    forget();
    drift_.begin(Scalar{});
    again_ = false;
    fresh_ = 0;
    taken_at_ = {};
    interrupt();
  }

  /// Ends a dip; where Fc is too uncertain another one begins.
  /// @return true if `adapt` would have been next
  bool interrupt() {
    const bool learnt = phase_ == Phase::adapt;
    dips_ = false;
    phase_ = Phase::start;
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
    // Most periods only watch, and are not to cost a search for their phase.
    if (phase_ != Phase::watch) {
      return act(now, map);
    }
    watch(now);
    return goes_on();
  }

  /// Fc that follows from the one before.
  Scalar force(Scalar before) const { return numeric::limited_product(before, force_change_); }

  /// The integral keeps what the new map does not explain.
  template <class Regulator>
  void correct(Regulator& regulator, const FrictionChange<Scalar>& change) const {
    if (dips_) {
      regulator.restart(change.target);
    } else {
      regulator.shift(change.target - unexplained(change.target), change.commanded);
    }
  }

  /// Sets a feedforward to what is known of the friction.
  template <class Feedforward>
  void adapt(Feedforward& feedforward, const FrictionLevel<Scalar>& level) const {
    feedforward.set_friction(level, contact_, inverse_gain_);
  }

  /// The filter is linear, the map is not: at the request that stands the adapted map has another ratio
  /// than the filter expects. The integral takes the difference, so that the request does not jump
  /// by it.
  template <class Regulator, class Feedforward>
  void align(Regulator& regulator, const Feedforward& map, Scalar speed, Scalar requested) {
    if (Scalar{} < expected_) {
      constexpr Scalar most = numeric::from_real<Scalar>(1.0 / 16.0);
      const Scalar beyond = half_log(requested, map.amplitude(expected_, speed));
      const Scalar quarter =
          numeric::rough_product(numeric::rough_product(reading_.slope.gain, beyond), expected_);
      regulator.shift(numeric::clamp_magnitude(numeric::twice(numeric::twice(quarter)), most),
                      Scalar{});
      expected_ = {};
    }
  }

  /// Variances of ln Fc, ln Kt and ln g. Fc may have changed since the last reading as much as it did
  /// before it, or as the request has moved since, or by less than a reading shows; and the error of the
  /// map may be one of Fc. Where readings contradict what was known of Kt and g, neither is sure.
  typename Estimate::Each variance() const {
    typename Estimate::Each all = estimate_.variance();
    if (estimate_.contradicted()) {
      all.stiffness = all.gain = Estimate::most_variance();
    }
    if (fresh_ > 0) {
      all.force = all.force + Drift::square_of_twice(numeric::twice(shown_));
    }
    all.force = all.force + drift_.variance() + Drift::square_of_twice(noise_) +
                Drift::square_of_twice(drift_.base()) + Drift::square_of_twice(mean_.moved());
    return all;
  }
  /// Kt g over the nominal one, and 1/g.
  const numeric::Floating<Scalar>& contact() const { return contact_; }
  const numeric::Floating<Scalar>& inverse_gain() const { return inverse_gain_; }

 private:
  using Drift = FrictionDrift<Scalar>;
  using Floating = numeric::Floating<Scalar>;
  enum class Phase : std::uint8_t {
    watch,
    start,
    prepare,
    velocity_slope,
    stiffness_slope,
    weigh,
    judge,
    learn,
    follow,
    adapt,
    resume
  };
  /// What the readings at a request are compared with.
  enum class Base : std::uint8_t {
    none,   ///< the first one is to be weighed
    first,  ///< the first one after that
    known   ///< what the first one has left
  };

  static constexpr std::uint32_t shown_after = 3;  ///< periods, of a request

  Task goes_on() const { return dips_ ? Task::pause : Task::regulate; }

  template <class Feedforward>
  Task act(const FrictionReading<Scalar>& now, const Feedforward& map) {
    switch (phase_) {
      case Phase::watch:
        break;
      case Phase::start:
        dip(uncertain());
        begin(now.requested);
        break;
      case Phase::prepare:
        prepare();
        slopes_.begin(mapped(), map, now.speed);
        break;
      case Phase::velocity_slope:
        reading_.slope.gain = slopes_.of_velocity(map, now.speed);
        if (Scalar{} < reading_.slope.gain) {
          begin(now.requested);
        } else {
          phase_ = Phase::stiffness_slope;
        }
        break;
      case Phase::stiffness_slope:
        reading_.slope.stiffness = slopes_.of_stiffness(map, now.speed, reading_.slope.gain);
        reading_.slope.force = one_half() - reading_.slope.stiffness;
        phase_ = Phase::weigh;
        break;
      case Phase::weigh:
        weigh();
        break;
      case Phase::judge:
        judge(now.requested);
        break;
      case Phase::learn:
        learn();
        return Task::learn;
      case Phase::follow:
        follow();
        return Task::learn;
      case Phase::adapt:
        conclude(now);
        return Task::adapt;
      case Phase::resume:
        resume(now);
        break;
    }
    return goes_on();
  }

  static constexpr Scalar one_half() { return numeric::from_real<Scalar>(0.5); }
  static Floating unity() { return numeric::rescaled(numeric::floating(one_half()), 1); }

  static bool another(Scalar request, Scalar than) {
    return SteadyMean<Scalar>::differs(request, than, numeric::from_real<Scalar>(1.0 / 16.0));
  }

  bool uncertain() const { return parameters_.certain < estimate_.variance().force; }

  void dip(bool dips) {
    dips_ = dips;
    count_ = 0;
  }

  /// The readings begin anew, with the request that stands.
  void begin(Scalar requested) {
    mean_.begin(requested);
    phase_ = Phase::watch;
  }

  void watch(const FrictionReading<Scalar>& now) {
    if (dips_) {
      ++count_;
      dips_ = count_ < parameters_.dip_periods;
      if (another(now.requested, request(now.speed))) {
        mean_.begin(now.requested);  // the drive is on its way
        return;
      }
    }
    if (mean_.take(now)) {
      compare(now);
    }
  }

  /// What the drive stands at.
  struct Place {
    Scalar request;
    Scalar ratio;  ///< measured, which the feedback holds at its target
    Scalar speed;
  };

  /// A request that friction alone has moved is at the same place: the map's error is the same there.
  static bool elsewhere(const Place& now, const Place& before) {
    return another(now.request, before.request) &&
           (another(now.ratio, before.ratio) || another(now.speed, before.speed));
  }

  /// A reading is complete.
  void compare(const FrictionReading<Scalar>& now) {
    place_ = {now.requested, mean_.measured(), now.speed};
    const bool moved = elsewhere(place_, taken_at_);
    if (mean_.limited() && !dips_) {
      dip(moved);
      taken_at_ = place_;
      begin(now.requested);
      return;
    }
    constexpr Scalar near_one = numeric::from_real<Scalar>(0.49);
    wanted_ = dips_ || moved || base_ == Base::none;
    tests_map_ = wanted_ && mapped() < near_one;
    reading_.innovation = half_log(mean_.measured(), mapped());
    if (base_ == Base::first) {
      base_ = Base::known;
      if (again_) {
        drift_.goes_on(explained(reading_.innovation));
      } else {
        drift_.begin(explained(reading_.innovation));
      }
      wanted_ = wanted_ || drift_.base() != reading_.innovation;
    }
    if (!wanted_) {
      constexpr Scalar jump = numeric::from_real<Scalar>(1.0 / 32.0);
      const Scalar shown = drift_.shown(reading_.innovation);
      if (numeric::abs(shown) < jump) {
        phase_ = Phase::judge;
        return;
      }
    }
    phase_ = Phase::prepare;
  }

  void judge(Scalar requested) {
    const Scalar shown = drift_.shown(reading_.innovation);
    if (drift_.moves(shown, noise_) || fresh_ == 1) {
      error_ = Drift::error(shown, noise_, reading_.slope.force);
      phase_ = Phase::follow;
    } else {
      drift_.rest();
      fresh_ = fresh_ > 0 ? fresh_ - 1 : 0;
      taken_at_ = place_;
      begin(requested);
    }
  }

  void follow() {
    change_force(drift_.follow(error_));
    if (fresh_ == 0) {
      return;
    }
    constexpr Scalar most = numeric::from_real<Scalar>(1.0 / 8.0);
    shown_ = numeric::clamp_magnitude(shown_ + (again_ ? error_ : drift_.change()), most);
    --fresh_;
    if (fresh_ == 0) {
      doubt();
    }
  }

  /// A friction that drifts has done so between the dip and the first reading after it, which has taken
  /// that for an error of the map. The first time all is learnt again, with a drift that is known.
  void doubt() {
    const bool sees_drift = numeric::twice(numeric::twice(noise_)) < numeric::abs(shown_);
    if (again_ || !sees_drift) {
      again_ = again_ && sees_drift;
      estimate_.widen(Drift::square_of_twice(shown_));
    } else {
      again_ = true;
      forget();
      drift_.set_change(numeric::half(numeric::half(shown_)));
    }
  }

  /// What readings have told of the constants.
  void forget() {
    estimate_.restart();
    contact_ = unity();
    inverse_gain_ = unity();
    base_ = Base::none;
  }

  /// The first reading after a dip, of a friction whose drift is known.
  bool led() const { return again_ && base_ == Base::none && !dips_; }

  /// Half of the change of ln Fc from the dip to that reading.
  Scalar drifted_since_dip() const { return drift_.change_over(mean_.moved_before()); }

  /// Ratio of the map where the drive stands; a dip has that of no drive.
  Scalar mapped() const { return dips_ ? one_half() : mean_.commanded(); }

  void prepare() {
    constexpr Scalar least = numeric::from_real<Scalar>(0x1p-12);
    const Floating inverse = inverse_of(numeric::max(mapped(), least));
    reading_.deviation = numeric::limited_product(parameters_.deviation, inverse);
    noise_ = numeric::limited_product(parameters_.noise, inverse);
    reading_.slope = {one_half(), Scalar{}, Scalar{}};
    estimate_.widen(drift_.variance());
    phase_ = dips_ ? Phase::weigh : Phase::velocity_slope;
  }

  /// A reading that is no jump, because Kt and g may be another by as much, is one of a drift.
  void weigh() {
    if (led()) {
      reading_.innovation = reading_.innovation - numeric::twice(numeric::rough_product(
                                                      reading_.slope.force, drifted_since_dip()));
    }
    phase_ = estimate_.weigh(reading_, wanted_, tests_map_) ? Phase::learn : Phase::judge;
  }

  void learn() {
    const typename Estimate::Each moved = estimate_.take();
    contact_ = numeric::product(numeric::product(contact_, exponential_of_twice(moved.stiffness)),
                                exponential_of_twice(moved.gain));
    inverse_gain_ = numeric::product(inverse_gain_, exponential_of_twice(-moved.gain));
    Scalar force = moved.force;
    if (dips_) {
      base_ = Base::none;
      fresh_ = 4;
      shown_ = Scalar{};
      if (again_) {
        drift_.goes_on(Scalar{});
      } else {
        drift_.begin(Scalar{});
      }
    } else if (led()) {
      base_ = small(moved) ? Base::known : Base::first;
      force = force + drifted_since_dip() + drift_.begin_ahead(explained(estimate_.residual()));
    } else if (small(moved)) {
      base_ = Base::known;
      drift_.goes_on(explained(estimate_.residual()));
      force = drift_.follow(force);
    } else {
      base_ = Base::first;
      drift_.begin(explained(estimate_.residual()));
    }
    far_ = numeric::from_real<Scalar>(0.25) < numeric::abs(force);
    change_force(force);
    if (!dips_) {
      // A jump is at the same place, of which a reading that it has cut through shows a wrong ratio.
      taken_at_ = wanted_ ? place_ : taken_at_;
      const Scalar measured =
          numeric::limited_product(mean_.measured(), exponential_of_twice(-force));
      expected_ = measured - unexplained(measured);
    }
  }

  /// The part of an innovation that an error of the map may be.
  Scalar explained(Scalar innovation) const {
    return numeric::clamp_magnitude(innovation, numeric::twice(reading_.deviation));
  }

  /// Of changes by which the filter, which is linear, leaves no error of the map.
  static bool small(const typename Estimate::Each& moved) {
    const auto below = [](Scalar x, double most) {
      return numeric::abs(x) < numeric::from_real<Scalar>(most);
    };
    return below(moved.force, 1.0 / 32.0) && below(moved.stiffness, 1.0 / 64.0) &&
           below(moved.gain, 1.0 / 64.0);
  }

  /// @param half  of the change of ln Fc
  void change_force(Scalar half) {
    force_change_ = exponential_of_twice(half);
    phase_ = Phase::adapt;
  }

  /// Part of a ratio that the map does not explain.
  Scalar unexplained(Scalar ratio) const {
    return numeric::twice(numeric::rough_product(ratio, drift_.base()));
  }

  void conclude(const FrictionReading<Scalar>& now) {
    if (base_ == Base::known) {
      count_ = 0;
      phase_ = Phase::resume;
    } else if (dips_ && far_) {
      dip(true);
      mean_.go_on(now.requested);
      phase_ = Phase::watch;
    } else {
      dip(!dips_ && uncertain());
      begin(now.requested);
    }
  }

  /// The next reading begins as soon as the sensor shows what the adapted map has requested.
  void resume(const FrictionReading<Scalar>& now) {
    if (another(now.requested, mean_.request())) {
      begin(now.requested);
    } else if (++count_ == shown_after) {
      mean_.go_on(now.requested);
      phase_ = Phase::watch;
    }
  }

  Parameters parameters_;
  SteadyMean<Scalar> mean_;
  MapSlopes<Scalar> slopes_;
  Estimate estimate_;
  Drift drift_;
  Floating contact_{};
  Floating inverse_gain_{};
  Floating force_change_{};
  typename Estimate::Reading reading_{};
  Scalar noise_{};     ///< half of that of a reading's logarithm
  Scalar error_{};     ///< half of that of ln Fc, which follow() takes from judge()
  Scalar expected_{};  ///< ratio of the adapted map at the request, as the filter has it; or 0
  Place place_{};      ///< of the reading that is complete
  Place taken_at_{};   ///< of the last one that was weighed, or showed nothing new
  std::uint32_t count_ = 0;  ///< periods of a dip, or since the map adapted
  Phase phase_ = Phase::start;
  Base base_ = Base::none;
  bool dips_ = false;
  bool wanted_ = false;     ///< the reading is taken in where it shows nothing new, too
  bool tests_map_ = false;  ///< it is the first one at another request, and depends on Kt and g
  bool far_ = false;        ///< the last change of Fc, from where the filter is not linear
  Scalar shown_{};          ///< of a drift, by the readings since the last dip
  std::uint8_t fresh_ = 0;  ///< of these readings, those that are still to come
  bool again_ = false;      ///< all is learnt again, because it drifted while it was learnt
};

}  // namespace sonoglide::control
