/// Friction force, contact stiffness and gain of the vibration, as a sequence of readings changes them.
#pragma once

#include <cstdint>

#include "firmware/control/friction/friction_drift.hpp"
#include "firmware/control/friction/friction_estimate.hpp"
#include "firmware/control/friction/half_logarithm.hpp"
#include "firmware/numeric/floating.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// A reading is a mean force, measured, over that of the map at the request, mapped. The first one at a
/// request is weighed in a FrictionEstimate. Those that follow it there move Fc by what they show beyond
/// the first one (FrictionDrift): the error of the map, of at most two deviations, is the same in all of
/// them. One that shows far more is weighed again, as a friction that has jumped.
///
/// A reading in a dip of the drive, where the sliding never reverses, is of Fc alone. A natural mode that rings
/// may reverse it, which lowers the mean force of a period, and nothing raises it above Fc. So where the highest
/// of a dip exceeds their mean by more than noise does, it is the reading, and Fc is less certain by half of what
/// it exceeds the mean by.
///
/// A friction that drifts moves between the dip and the first reading after it as well, which takes that
/// for an error of Kt and g. Four readings later the drift is known: where it shows, by more than four
/// times their noise, all is forgotten and learnt again, once, in a dip after which Fc is moved by the
/// drift up to the first reading. Fc is less certain by what four readings show in any case.
///
/// A reading takes compare(); and judge() and follow() where it is one of those that follow, or else
/// prepare(), the slopes, weigh() and learn(). Ratios on base 2.
template <class ScalarT>
class TrackedConstants {
 public:
  using Scalar = ScalarT;
  using Estimate = FrictionEstimate<Scalar>;
  using Each = typename Estimate::Each;
  using Floating = numeric::Floating<Scalar>;

  struct Parameters {
    Scalar deviation;  ///< of a mean force, a quarter of it over Fc
    Scalar noise;      ///< the part of it that is another in each reading, likewise
    Scalar scatter;    ///< the most by which noise raises a period's force, half of it over Fc
    typename Estimate::Parameters start;

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("deviation", self.deviation);
      visit("noise", self.noise);
      visit("scatter", self.scatter);
      visit("start", self.start);
    }
  };

  /// A reading that is complete.
  struct Complete {
    Scalar measured;
    Scalar highest;  ///< of its periods
    Scalar mapped;
    bool dips;       ///< it is of a dip
    bool elsewhere;  ///< at another request than the one before
  };

  explicit TrackedConstants(const Parameters& parameters)
      : deviation_(parameters.deviation),
        noise_part_(parameters.noise),
        scatter_(parameters.scatter),
        estimate_(parameters.start) {}

  void restart() {
    estimate_.restart();
    forget();
    drift_.begin(Scalar{});
    again_ = false;
    fresh_ = 0;
    ringing_ = {};
    strayed_ = {};
  }

  /// Kt g over the nominal one, and 1/g.
  const Floating& contact() const { return contact_; }
  const Floating& inverse_gain() const { return inverse_gain_; }
  /// Fc over the one before the last learn() or follow().
  const Floating& force_change() const { return force_change_; }

  /// Variances of ln Fc, ln Kt and ln g by the readings that were weighed.
  const Each& weighed_variance() const { return estimate_.variance(); }

  /// The same, as they are told: those of Kt and g also cover a gain far from what was known at the start. Fc
  /// may have changed since the last reading as much as it did before it, or as the request has moved since, or
  /// by less than a reading shows; and the error of the map may be one of Fc. Where readings contradict what was
  /// known of Kt and g, neither is sure, nor is Fc to 1.6 % until four readings after the dip have told whether
  /// it drifts.
  /// @param moved  by which the request has moved, half of it over itself
  Each variance(Scalar moved) const {
    Each all = estimate_.stated_variance();
    if (estimate_.contradicted()) {
      constexpr Scalar drift = numeric::from_real<Scalar>(1.0 / 4096.0);
      all.stiffness = all.gain = Estimate::most_variance();
      all.force = fresh_ > 0 ? all.force + drift : all.force;
    }
    if (fresh_ > 0) {
      all.force = all.force + Drift::square_of_twice(numeric::twice(shown_));
    }
    all.force = all.force + drift_.variance() + Drift::square_of_twice(noise_) +
                Drift::square_of_twice(drift_.base()) + Drift::square_of_twice(moved) +
                numeric::rough_product(ringing_, ringing_);
    return all;
  }

  /// @return true: the reading is to be weighed, else judged
  bool compare(const Complete& reading) {
    constexpr Scalar near_one = numeric::from_real<Scalar>(0.49);
    wanted_ = reading.dips || reading.elsewhere || base_ == Base::none;
    tests_map_ = (wanted_ || base_ == Base::first) && reading.mapped < near_one;
    reading_.innovation =
        half_log(reading.dips ? reached(reading) : reading.measured, reading.mapped);
    if (base_ == Base::first) {
      base_ = Base::known;
      if (again_) {
        drift_.goes_on(explained(reading_.innovation));
      } else {
        drift_.begin(explained(reading_.innovation));
      }
      wanted_ = wanted_ || drift_.base() != reading_.innovation;
    }
    constexpr Scalar jump = numeric::from_real<Scalar>(1.0 / 32.0);
    return wanted_ || !(numeric::abs(drift_.shown(reading_.innovation)) < jump);
  }

  /// The reading is taken in where it shows nothing new, too.
  bool wanted() const { return wanted_; }

  /// @return true: the reading is to be followed, else it shows nothing new
  bool judge() {
    const Scalar shown = drift_.shown(reading_.innovation);
    if (drift_.moves(shown, noise_) || fresh_ == 1) {
      force_error_ = Drift::error(shown, noise_, reading_.slope.force);
      return true;
    }
    drift_.rest();
    fresh_ = fresh_ > 0 ? fresh_ - 1 : 0;
    return false;
  }

  /// Fc changes.
  void follow() {
    const Scalar change = drift_.follow(force_error_);
    change_force(change);
    strayed_ = numeric::clamp_magnitude(strayed_ + change, numeric::from_real<Scalar>(1.0 / 2.0));
    if (fresh_ == 0) {
      return;
    }
    constexpr Scalar most = numeric::from_real<Scalar>(1.0 / 8.0);
    shown_ = numeric::clamp_magnitude(shown_ + (again_ ? force_error_ : drift_.change()), most);
    --fresh_;
    if (fresh_ == 0) {
      doubt();
    }
  }

  /// @param mapped  ratio of the map where the drive stands
  void prepare(Scalar mapped) {
    constexpr Scalar least = numeric::from_real<Scalar>(0x1p-12);
    const Floating inverse = inverse_of(numeric::max(mapped, least));
    reading_.deviation = numeric::limited_product(deviation_, inverse);
    noise_ = numeric::limited_product(noise_part_, inverse);
    reading_.slope = {one_half(), Scalar{}, Scalar{}};
    estimate_.widen(drift_.variance());
  }

  /// Halves of the slopes of ln F over ln g and ln Kt.
  Scalar gain_slope() const { return reading_.slope.gain; }
  void set_gain_slope(Scalar slope) { reading_.slope.gain = slope; }
  void set_stiffness_slope(Scalar slope) {
    reading_.slope.stiffness = slope;
    reading_.slope.force = one_half() - slope;
  }

  /// A reading that is no jump, because Kt and g may be another by as much, is one of a drift.
  /// `dips`: the reading is one of a dip. `moved`: periods in which the request moved before it, over 256.
  /// @return true: the reading is to be learnt from, else judged
  bool weigh(bool dips, Scalar moved) {
    if (led(dips)) {
      reading_.innovation =
          reading_.innovation -
          numeric::twice(numeric::rough_product(reading_.slope.force, drift_.change_over(moved)));
    }
    return estimate_.weigh(reading_, wanted_, tests_map_);
  }

  /// Fc, Kt and g change.
  /// @return half of the change of ln Fc
  Scalar learn(bool dips, Scalar moved) {
    const Each change = estimate_.take();
    contact_ = numeric::product(numeric::product(contact_, exponential_of_twice(change.stiffness)),
                                exponential_of_twice(change.gain));
    inverse_gain_ = numeric::product(inverse_gain_, exponential_of_twice(-change.gain));
    Scalar force = change.force;
    if (dips) {
      base_ = Base::none;
      fresh_ = 4;
      shown_ = Scalar{};
      strayed_ = Scalar{};
      if (again_) {
        drift_.goes_on(Scalar{});
      } else {
        drift_.begin(Scalar{});
      }
    } else if (led(dips)) {
      base_ = small(change) ? Base::known : Base::first;
      force =
          force + drift_.change_over(moved) + drift_.begin_ahead(explained(estimate_.residual()));
    } else if (small(change)) {
      base_ = Base::known;
      drift_.goes_on(explained(estimate_.residual()));
      force = drift_.follow(force);
    } else {
      base_ = Base::first;
      drift_.begin(explained(estimate_.residual()));
    }
    change_force(force);
    return force;
  }

  /// Kt or g is none of what was known, and Fc has moved by more than 1/8 since the last dip: what has moved
  /// may be the vibration.
  bool astray() const {
    constexpr Scalar most = numeric::from_real<Scalar>(1.0 / 16.0);
    return estimate_.contradicted() && most < numeric::abs(strayed_);
  }

  /// The readings that follow are compared with what the last one has left.
  bool has_base() const { return base_ == Base::known; }

  /// Part of a ratio that the map does not explain.
  Scalar unexplained(Scalar ratio) const {
    return numeric::twice(numeric::rough_product(ratio, drift_.base()));
  }

 private:
  using Drift = FrictionDrift<Scalar>;
  /// What the readings at a request are compared with.
  enum class Base : std::uint8_t {
    none,   ///< the first one is to be weighed
    first,  ///< the first one after that
    known   ///< what the first one has left
  };

  static constexpr Scalar one_half() { return numeric::from_real<Scalar>(0.5); }
  static Floating unity() { return numeric::rescaled(numeric::floating(one_half()), 1); }

  /// Force of a dip in which the sliding does not reverse.
  Scalar reached(const Complete& dip) {
    constexpr Scalar most = numeric::from_real<Scalar>(1.0 / 4.0);
    const bool rings = scatter_ < dip.highest - dip.measured;
    ringing_ = rings ? numeric::min(half_log(dip.highest, dip.measured), most) : Scalar{};
    return rings ? dip.highest : dip.measured;
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
    estimate_.forget();
    contact_ = unity();
    inverse_gain_ = unity();
    base_ = Base::none;
  }

  /// The first reading after a dip, of a friction whose drift is known.
  bool led(bool dips) const { return again_ && base_ == Base::none && !dips; }

  /// The part of an innovation that an error of the map may be.
  Scalar explained(Scalar innovation) const {
    return numeric::clamp_magnitude(innovation, numeric::twice(reading_.deviation));
  }

  /// Of changes by which the filter, which is linear, leaves no error of the map.
  static bool small(const Each& change) {
    const auto below = [](Scalar x, double most) {
      return numeric::abs(x) < numeric::from_real<Scalar>(most);
    };
    return below(change.force, 1.0 / 32.0) && below(change.stiffness, 1.0 / 64.0) &&
           below(change.gain, 1.0 / 64.0);
  }

  /// @param half  of the change of ln Fc
  void change_force(Scalar half) { force_change_ = exponential_of_twice(half); }

  Scalar deviation_;
  Scalar noise_part_;
  Scalar scatter_;
  Estimate estimate_;
  Drift drift_;
  Floating contact_{};
  Floating inverse_gain_{};
  Floating force_change_{};
  typename Estimate::Reading reading_{};
  Scalar noise_{};        ///< half of that of a reading's logarithm
  Scalar force_error_{};  ///< half of that of ln Fc, by the reading that was judged
  Scalar shown_{};        ///< of a drift, by the readings since the last dip
  Scalar strayed_{};      ///< by which ln Fc has followed since the last dip, half
  Scalar ringing_{};      ///< half of ln highest/mean in the last dip, where it is not noise
  Base base_ = Base::none;
  bool wanted_ = false;
  bool tests_map_ =
      false;  ///< the reading is one of the first at a request, and depends on Kt and g
  std::uint8_t fresh_ = 0;  ///< of the readings since the last dip, those that are still to come
  bool again_ = false;      ///< all is learnt again, because it drifted while it was learnt
};

}  // namespace sonoglide::control
