/// What the vibration shows of a resonator that is driven near its resonance.
#pragma once

#include <cstdint>

#include "firmware/control/past_drive.hpp"
#include "firmware/numeric/floating.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/polar.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// Envelope of the vibration velocity Re(z e^jθ), z = r (c + js), θ the phase of the drive. Over a
/// carrier period, u the amplitude of the drive:
///   r' = r + q (u c − h r),   ψ' = ψ + 2π(n − w) − (q u/r) s.
/// q is the velocity gained in a period at full drive, h the amplitude that holds a velocity of 1
/// against the losses, n the natural frequency, w that of the drive.
///
/// Each period corrects the estimates by what they did not foresee (gradient, for h and n normalised,
/// Widrow 1985, README.md). The turn of ψ shows n. Where the drive beyond the losses, u c − h r, foreseen and
/// seen, is more than four times the losses and than what noise makes of it, growth shows q, and
/// otherwise h.
///
/// Velocities on one base, r at most 1. Amplitudes: base the largest. Frequencies: deviation from
/// the start, relative to it, base 1/8. h: base 16.
template <class Scalar>
class ResonanceEstimate {
 public:
  struct Parameters {
    numeric::Split<Scalar> rate;  ///< believed q; a quarter to four times of it are allowed
    Scalar losses;                ///< believed h
    Scalar natural;               ///< believed n
    Scalar lowest;                ///< end of the frequency range
    Scalar highest;               ///< likewise
    Scalar rate_gain;             ///< twice the part of a miss that corrects q at once
    Scalar losses_gain;           ///< an eighth of that part for h
    Scalar natural_gain;          ///< that part for n; after the beginning, where it is more
    Scalar audible;               ///< least velocity that has a direction
    Scalar surprise;              ///< half of the drive that a period may seem to have missed
    Scalar unrest;                ///< half of the surplus that noise alone may ask for

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("rate", self.rate);
      visit("losses", self.losses);
      visit("natural", self.natural);
      visit("lowest", self.lowest);
      visit("highest", self.highest);
      visit("rate_gain", self.rate_gain);
      visit("losses_gain", self.losses_gain);
      visit("natural_gain", self.natural_gain);
      visit("audible", self.audible);
      visit("surprise", self.surprise);
      visit("unrest", self.unrest);
    }
  };

  explicit ResonanceEstimate(const Parameters& parameters)
      : parameters_(parameters),
        // The factor of q is on base 4.
        twice_believed_rate_(numeric::rescaled(numeric::floating(parameters.rate), 3)) {
    restart();
  }

  /// Believes what it was told at first; the next sample has none before it.
  void restart() {
    rate_factor_ = numeric::from_real<Scalar>(0.25);
    losses_ = parameters_.losses;
    take_natural(parameters_.natural);
    take_rate();
    modulus_ = {};
    cosine_ = whole();
    sine_ = {};
    natural_gain_ = whole();
    first_ = true;
  }

  /// One call for each sample: z, and the commands in force in the period before and in this one.
  /// @return whether growth and turn of the vibration were nearly as foreseen: the turn to a
  ///         quarter of a radian, the growth to `surprise`
  bool observe(Scalar in_phase, Scalar quadrature, const PastCommand<Scalar>& before,
               const PastCommand<Scalar>& now) {
    const numeric::Polar<Scalar> seen = numeric::polar(in_phase, quadrature);
    // z is a mean over its period, and shows half of either command.
    const Scalar amplitude = numeric::half_sum(before.amplitude, now.amplitude);
    // Without a drive there is nothing to foresee but the decay: what moves then is not of the drive.
    const bool driven = before.amplitude != Scalar{} || now.amplitude != Scalar{};
    const bool known = driven && !first_;
    first_ = false;
    const bool grew = !known || follow_growth(seen, amplitude);
    bool turned = true;
    if (known && parameters_.audible < modulus_ && parameters_.audible < seen.modulus) {
      turned = follow_turn(seen, amplitude,
                           natural_ - numeric::half_sum(before.deviation, now.deviation));
    } else {
      natural_gain_ = whole();
    }
    modulus_ = seen.modulus;
    const bool directed = parameters_.audible < seen.modulus;
    cosine_ = directed ? seen.cosine : whole();
    sine_ = directed ? seen.sine : Scalar{};
    return grew && turned;
  }

  Scalar modulus() const { return modulus_; }  ///< r, mean over the sampled period
  Scalar cosine() const { return cosine_; }    ///< c; 1 where the vibration has no direction
  Scalar sine() const { return sine_; }
  Scalar natural() const { return natural_; }

  /// A vibration of this velocity has a direction.
  bool is_audible(Scalar velocity) const { return parameters_.audible < velocity; }

  /// The natural frequency seems to lie at an end of the range, or beyond.
  bool at_end() const { return at_end_; }
  Scalar in_range(Scalar deviation) const {
    return numeric::clamp(deviation, parameters_.lowest, parameters_.highest);
  }

  /// h r; in fixed point at most 1.
  Scalar holding(Scalar velocity) const {
    constexpr int base = 4;
    if constexpr (numeric::is_fixed_point_v<Scalar>) {
      return numeric::lifted(numeric::half_product(losses_, velocity), base + 1);
    } else {
      return numeric::scale_by_power_of_two(losses_ * velocity, base);
    }
  }

  /// q (u c − h r), c the present one.
  Scalar growth(Scalar amplitude, Scalar velocity) const {
    return gained(half_surplus(amplitude, cosine_, velocity));
  }

  const numeric::Floating<Scalar>& inverse_rate() const { return inverse_rate_; }  ///< 1/q

 private:
  static constexpr Scalar whole() { return numeric::from_code<Scalar>(INT32_MAX); }

  /// (u c − h r)/2
  Scalar half_surplus(Scalar amplitude, Scalar cosine, Scalar velocity) const {
    return numeric::half_difference(numeric::rough_product(amplitude, cosine), holding(velocity));
  }
  Scalar gained(Scalar half_surplus) const {
    return numeric::limited_product(half_surplus, twice_rate_);
  }

  void take_natural(Scalar deviation) {
    at_end_ = !(parameters_.lowest < deviation && deviation < parameters_.highest);
    natural_ = at_end_ ? in_range(deviation) : deviation;
  }

  bool follow_turn(const numeric::Polar<Scalar>& seen, Scalar amplitude, Scalar beside) {
    constexpr Scalar radians = numeric::from_real<Scalar>(0.78539816339744831);       // 2π/8
    constexpr Scalar from_radians = numeric::from_real<Scalar>(0.63661977236758134);  // 8/2π/2
    constexpr Scalar third = numeric::from_real<Scalar>(1.0 / 3.0);
    constexpr Scalar foreseen = numeric::from_real<Scalar>(0.125);
    const Scalar half_turned =
        numeric::half_product(seen.sine, cosine_) - numeric::half_product(seen.cosine, sine_);
    const Scalar pull = numeric::limited_product(
        numeric::limited_product(numeric::half(amplitude), twice_rate_), seen.inverse);
    const Scalar half_miss =
        half_turned - numeric::half_product(radians, beside) +
        numeric::half_product(numeric::clamp_magnitude(pull, whole()), seen.sine);
    const Scalar quarter =
        numeric::rough_product(numeric::rough_product(natural_gain_, half_miss), from_radians);
    take_natural(natural_ + numeric::scale_by_power_of_two(quarter, 2));
    natural_gain_ = numeric::max(
        parameters_.natural_gain,
        natural_gain_ -
            numeric::rough_product(numeric::rough_product(natural_gain_, natural_gain_), third));
    if (numeric::abs(half_miss) < foreseen) {
      return true;
    }
    natural_gain_ = numeric::max(natural_gain_, numeric::from_real<Scalar>(0.25));
    return false;
  }

  bool follow_growth(const numeric::Polar<Scalar>& seen, Scalar amplitude) {
    const Scalar surplus = half_surplus(amplitude, seen.cosine, modulus_);
    const Scalar half_miss = numeric::half_difference(seen.modulus - modulus_, gained(surplus));
    const Scalar half_drive = numeric::limited_product(half_miss, inverse_rate_);
    const Scalar quarter_grown = numeric::half_sum(surplus, half_drive);
    if (parts_from_losses(numeric::half(surplus)) && parts_from_losses(quarter_grown)) {
      correct_rate(surplus * half_drive);
    } else if (parameters_.audible < modulus_) {
      correct_losses(numeric::limited_product(half_drive, seen.inverse));
    }
    return numeric::abs(half_drive) <= parameters_.surprise;
  }

  /// Whether a wrong h would hardly show in it, and noise would not.
  /// @param quarter  of a drive beyond the losses
  bool parts_from_losses(Scalar quarter) const {
    constexpr Scalar most = numeric::from_real<Scalar>(0.245);  // four times that is full drive
    return numeric::max(numeric::min(most, holding(modulus_)), numeric::half(parameters_.unrest)) <
           numeric::abs(quarter);
  }

  /// @param gradient  a quarter of surplus times missed drive
  void correct_rate(Scalar gradient) {
    constexpr Scalar most = numeric::from_real<Scalar>(0.125);
    constexpr Scalar least_factor = numeric::from_real<Scalar>(0.0625);
    const Scalar part =
        numeric::twice(numeric::clamp_magnitude(parameters_.rate_gain * gradient, most));
    const Scalar room = whole() - rate_factor_;
    rate_factor_ =
        numeric::max(least_factor, rate_factor_ + numeric::min(room, rate_factor_ * part));
    take_rate();
  }

  void take_rate() {
    twice_rate_ = numeric::product(twice_believed_rate_, numeric::floating(rate_factor_));
    const auto quarter = numeric::floating(numeric::from_real<Scalar>(0.5));
    inverse_rate_ = numeric::rescaled(numeric::quotient(quarter, twice_rate_), 2);
  }

  /// @param part  half of the missed drive over the velocity
  void correct_losses(Scalar part) {
    constexpr Scalar least = numeric::from_real<Scalar>(0x1p-20);
    constexpr Scalar most = numeric::from_real<Scalar>(0.999);
    losses_ = numeric::clamp(losses_ - numeric::rough_product(parameters_.losses_gain, part), least,
                             most);
  }

  Parameters parameters_;
  numeric::Floating<Scalar> twice_believed_rate_;
  numeric::Floating<Scalar> twice_rate_{};    ///< 2q
  numeric::Floating<Scalar> inverse_rate_{};  ///< 1/q
  Scalar rate_factor_{};                      ///< q over what it was believed to be, base 4
  Scalar losses_{};                           ///< h
  Scalar natural_{};                          ///< n
  Scalar natural_gain_{};
  Scalar modulus_{};
  Scalar cosine_{};
  Scalar sine_{};
  bool at_end_ = false;
  bool first_ = true;  ///< no sample has come yet
};

}  // namespace sonoglide::control
