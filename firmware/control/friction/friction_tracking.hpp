/// Friction force, contact stiffness and gain of the vibration, learnt while the drive is on.
#pragma once

#include <cstdint>

#include "firmware/control/friction/friction_level.hpp"
#include "firmware/control/friction/half_logarithm.hpp"
#include "firmware/control/friction/map_slopes.hpp"
#include "firmware/control/friction/periodic_relearning.hpp"
#include "firmware/control/friction/steady_mean.hpp"
#include "firmware/control/friction/tracked_constants.hpp"
#include "firmware/control/interface/part_name.hpp"
#include "firmware/control/interface/ratio.hpp"
#include "firmware/numeric/floating.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// Takes readings (SteadyMean) wherever the request stands still: the mean force, over that of the map at
/// the request, which is the commanded ratio. What they tell is in TrackedConstants.
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
/// Ratios on base 2. Speeds and requests: base the peak vibration velocity at full drive.
template <class ScalarT>
class FrictionTracking {
 public:
  static constexpr PartName part_name{"friction/friction_tracking", "FrictionTracking"};
  using Scalar = ScalarT;
  using Constants = TrackedConstants<Scalar>;
  using Estimate = typename Constants::Estimate;

  struct Parameters {
    typename SteadyMean<Scalar>::Parameters mean;
    typename Constants::Parameters constants;
    Scalar certain;             ///< variance of ln Fc up to which the request does not dip
    std::uint16_t dip_periods;  ///< after which a dip ends that has no reading
    Scalar edge;  ///< request of a dip, over the nominal one at which the sliding first stops

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("mean", self.mean);
      visit("constants", self.constants);
      visit("certain", self.certain);
      visit("dip_periods", self.dip_periods);
      visit("edge", self.edge);
    }
  };

  explicit FrictionTracking(const Parameters& parameters)
      : certain_(parameters.certain),
        dip_periods_(parameters.dip_periods),
        edge_(parameters.edge),
        mean_(parameters.mean),
        constants_(parameters.constants) {
    restart();
  }

  void restart() {
    constants_.restart();
    taken_at_ = {};
    dips_ = false;
    phase_ = Phase::start;
  }

  /// Ends a dip, with `adapt` if that would have been next; where Fc is too uncertain another one begins.
  /// Out of line: few periods need it.
  template <class Feedforward>
  [[gnu::noinline]] void interrupt(Feedforward& feedforward, const FrictionLevel<Scalar>& level) {
    const bool learnt = phase_ == Phase::adapt;
    dips_ = false;
    phase_ = Phase::start;
    if (learnt) {
      adapt(feedforward, level);
    }
  }

  bool pausing() const { return dips_; }

  /// Of the drive in a dip. @param speed  of the sliding
  Scalar request(Scalar speed) const {
    return numeric::rough_product(numeric::limited_product(speed, constants_.inverse_gain()),
                                  edge_);
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
  Scalar force(Scalar before) const {
    return numeric::limited_product(before, constants_.force_change());
  }

  /// The integral keeps what the new map does not explain.
  template <class Regulator>
  void correct(Regulator& regulator, const FrictionChange<Scalar>& change) const {
    if (dips_) {
      regulator.restart(change.target);
    } else {
      regulator.shift(change.target - constants_.unexplained(change.target), change.commanded);
    }
  }

  /// Sets a feedforward to what is known of the friction.
  template <class Feedforward>
  void adapt(Feedforward& feedforward, const FrictionLevel<Scalar>& level) const {
    feedforward.set_friction(level, constants_.contact(), constants_.inverse_gain());
  }

  /// The filter is linear, the map is not: at the request that stands the adapted map has another ratio
  /// than the filter expects. The integral takes the difference, so that the request does not jump
  /// by it.
  template <class Regulator, class Feedforward>
  void align(Regulator& regulator, const Feedforward& map, Scalar speed, Scalar requested) {
    if (Scalar{} < expected_) {
      constexpr Scalar most = numeric::from_real<Scalar>(1.0 / 16.0);
      const Scalar beyond = half_log(requested, map.amplitude(expected_, speed));
      const Scalar quarter = numeric::rough_product(
          numeric::rough_product(constants_.gain_slope(), beyond), expected_);
      regulator.shift(numeric::clamp_magnitude(numeric::twice(numeric::twice(quarter)), most),
                      Scalar{});
      expected_ = {};
    }
  }

  /// Variances of ln Fc, ln Kt and ln g.
  typename Estimate::Each variance() const { return constants_.variance(mean_.moved()); }
  /// Kt g over the nominal one, and 1/g.
  const numeric::Floating<Scalar>& contact() const { return constants_.contact(); }
  const numeric::Floating<Scalar>& inverse_gain() const { return constants_.inverse_gain(); }

 private:
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
        constants_.prepare(mapped());
        phase_ = dips_ ? Phase::weigh : Phase::velocity_slope;
        slopes_.begin(mapped(), map, now.speed);
        break;
      case Phase::velocity_slope:
        constants_.set_gain_slope(slopes_.of_velocity(map, now.speed));
        if (Scalar{} < constants_.gain_slope()) {
          begin(now.requested);
        } else {
          phase_ = Phase::stiffness_slope;
        }
        break;
      case Phase::stiffness_slope:
        constants_.set_stiffness_slope(
            slopes_.of_stiffness(map, now.speed, constants_.gain_slope()));
        phase_ = Phase::weigh;
        break;
      case Phase::weigh:
        phase_ = constants_.weigh(dips_, mean_.moved_before()) ? Phase::learn : Phase::judge;
        break;
      case Phase::judge:
        judge(now.requested);
        break;
      case Phase::learn:
        learn();
        return Task::learn;
      case Phase::follow:
        constants_.follow();
        phase_ = Phase::adapt;
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

  static bool another(Scalar request, Scalar than) {
    return SteadyMean<Scalar>::differs(request, than, numeric::from_real<Scalar>(1.0 / 16.0));
  }

  bool uncertain() const { return certain_ < constants_.weighed_variance().force; }

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
      dips_ = count_ < dip_periods_;
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

  /// Ratio of the map where the drive stands; a dip has that of no drive.
  Scalar mapped() const { return dips_ ? whole_ratio<Scalar> : mean_.commanded(); }

  /// A reading is complete. Out of line: most periods only watch.
  [[gnu::noinline]] void compare(const FrictionReading<Scalar>& now) {
    place_ = {now.requested, mean_.measured(), now.speed};
    const bool moved = elsewhere(place_, taken_at_);
    if (mean_.limited() && !dips_) {
      dip(moved);
      taken_at_ = place_;
      begin(now.requested);
      return;
    }
    phase_ = constants_.compare({mean_.measured(), mean_.highest(), mapped(), dips_, moved})
                 ? Phase::prepare
                 : Phase::judge;
  }

  void judge(Scalar requested) {
    if (constants_.judge()) {
      phase_ = Phase::follow;
    } else {
      taken_at_ = place_;
      begin(requested);
    }
  }

  void learn() {
    const Scalar half = constants_.learn(dips_, mean_.moved_before());
    far_ = numeric::from_real<Scalar>(0.25) < numeric::abs(half);
    phase_ = Phase::adapt;
    if (!dips_) {
      // A jump is at the same place, of which a reading that it has cut through shows a wrong ratio.
      taken_at_ = constants_.wanted() ? place_ : taken_at_;
      const Scalar measured =
          numeric::limited_product(mean_.measured(), exponential_of_twice(-half));
      expected_ = measured - constants_.unexplained(measured);
    }
  }

  void conclude(const FrictionReading<Scalar>& now) {
    if (constants_.has_base() && !constants_.astray()) {
      count_ = 0;
      phase_ = Phase::resume;
    } else if (dips_ && far_) {
      dip(true);
      mean_.go_on(now.requested);
      phase_ = Phase::watch;
    } else {
      dip(!dips_ && (uncertain() || constants_.astray()));
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

  Scalar certain_;
  std::uint16_t dip_periods_;
  Scalar edge_;
  SteadyMean<Scalar> mean_;
  MapSlopes<Scalar> slopes_;
  Constants constants_;
  Scalar expected_{};  ///< ratio of the adapted map at the request, as the filter has it; or 0
  Place place_{};      ///< of the reading that is complete
  Place taken_at_{};   ///< of the last one that was weighed, or showed nothing new
  std::uint32_t count_ = 0;  ///< periods of a dip, or since the map adapted
  Phase phase_ = Phase::start;
  bool dips_ = false;
  bool far_ = false;  ///< the last change of Fc was from where the filter is not linear
};

}  // namespace sonoglide::control
