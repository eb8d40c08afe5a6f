/// What the vibration shows of a resonator that is driven near its resonance.
#pragma once

#include <cstdint>

#include "firmware/numeric/floating.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/polar.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

template <class Scalar>
struct PastCommand {
  Scalar amplitude;    ///< base: the largest; below 0 the phase is turned by half a turn
  Scalar deviation;    ///< of the frequency from the start, relative to it, base 1/8
  std::int32_t steps;  ///< the same in steps of the frequency word
};

/// Envelope of the vibration velocity Re(z e^jθ), z = r (c + js), θ the phase of the drive. Over a
/// carrier period, u the amplitude of the drive:
///   r' = r + q (u c − h r),   ψ' = ψ + 2π(n − w) − (q u/r) s.
/// q is the velocity gained in a period at full drive, h the amplitude that holds a velocity of 1
/// against the losses, n the natural frequency, w that of the drive.
///
/// Each period corrects the estimates by what they did not foresee (gradient, for h and n
/// normalised, Widrow 1985, ../README.md). The turn of ψ shows n. Where the drive beyond the losses, u
/// c − h r, foreseen and seen, is more than four times the losses and than what noise makes of it,
/// growth shows q, and otherwise h.
///
/// Velocities on one base, r at most 1. Amplitudes: base the largest. Frequencies: deviation from
/// the start, relative to it, base 1/8. In fixed point h is on base 16, q at most 1/2, and what
/// needs headroom is kept by halves (kept()).
template <class Scalar>
class ResonanceEstimate {
 public:
  struct Parameters {
    numeric::Split<Scalar> rate;  ///< nominal q; a quarter to four times of it are allowed
    Scalar losses;                ///< nominal h
    Scalar natural;               ///< nominal n
    Scalar lowest;                ///< end of the frequency range
    Scalar highest;               ///< likewise
    Scalar rate_gain;             ///< twice the part of a miss that corrects q at once
    Scalar losses_gain;           ///< an eighth of that part for h
    Scalar quiet_losses;          ///< part of a miss within `unrest` that counts for h
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
      visit("quiet_losses", self.quiet_losses);
      visit("natural_gain", self.natural_gain);
      visit("audible", self.audible);
      visit("surprise", self.surprise);
      visit("unrest", self.unrest);
    }
  };

  explicit ResonanceEstimate(const Parameters& parameters)
      : parameters_(parameters),
        // The factor of q is on base 4.
        nominal_rate_(numeric::rescaled(numeric::floating(parameters.rate), 2 + kept_bits)),
        // Products of two kept numbers, or one, and where h is on another base.
        rate_gain_(on_base(parameters.rate_gain, -2)),
        losses_gain_(on_base(parameters.losses_gain, losses_bits - 1)),
        surprise_(on_base(parameters.surprise, 1)),
        unrest_(on_base(parameters.unrest, 1)) {
    restart();
  }

  /// Believes what it was told at first; the next sample has none before it.
  void restart() {
    rate_factor_ = numeric::from_real<Scalar>(0.25);
    losses_ = on_base(parameters_.losses, losses_bits);
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
    const numeric::Polar<Scalar> measured = numeric::polar(in_phase, quadrature);
    // z is a mean over its period, and shows half of either command.
    const Scalar amplitude = numeric::half_sum(before.amplitude, now.amplitude);
    // Without a drive there is nothing to foresee but the decay: what moves then is not of the
    // drive.
    const bool driven = before.amplitude != Scalar{} || now.amplitude != Scalar{};
    const bool known = driven && !first_;
    first_ = false;
    const bool grew = !known || follow_growth(measured, amplitude);
    bool rotated = true;
    if (known && parameters_.audible < modulus_ && parameters_.audible < measured.modulus) {
      rotated = follow_rotation(measured, amplitude,
                                natural_ - numeric::half_sum(before.deviation, now.deviation));
    } else {
      natural_gain_ = whole();
    }
    modulus_ = measured.modulus;
    const bool directed = parameters_.audible < measured.modulus;
    cosine_ = directed ? measured.cosine : whole();
    sine_ = directed ? measured.sine : Scalar{};
    return grew && rotated;
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
    return numeric::lifted(numeric::kept_product(losses_, velocity), losses_bits + 1);
  }

  /// q (u c − h r), c the present one.
  Scalar growth(Scalar amplitude, Scalar velocity) const {
    return gained(surplus(amplitude, cosine_, velocity));
  }

  const numeric::Multiple<Scalar>& inverse_rate() const { return inverse_rate_; }  ///< 1/q

 private:
  static constexpr int kept_bits = numeric::is_fixed_point_v<Scalar> ? 1 : 0;
  static constexpr int losses_bits = 4;  ///< of the base of h, in the parameters and in fixed point

  static constexpr Scalar whole() { return numeric::from_code<Scalar>(INT32_MAX); }

  /// x 2^bits in floating point, whose numbers are on base 1.
  static constexpr Scalar on_base(Scalar x, int bits) {
    return numeric::is_fixed_point_v<Scalar> ? x : numeric::scale_by_power_of_two(x, bits);
  }

  /// u c − h r, kept
  Scalar surplus(Scalar amplitude, Scalar cosine, Scalar velocity) const {
    return numeric::difference_with_lifted(amplitude, cosine, losses_, velocity, losses_bits);
  }
  /// @param surplus  kept
  Scalar gained(Scalar surplus) const { return numeric::rough_product(surplus, rate_); }

  void take_natural(Scalar deviation) {
    at_end_ = !(parameters_.lowest < deviation && deviation < parameters_.highest);
    natural_ = at_end_ ? in_range(deviation) : deviation;
  }

  bool follow_rotation(const numeric::Polar<Scalar>& measured, Scalar amplitude, Scalar beside) {
    constexpr Scalar radians = numeric::from_real<Scalar>(0.78539816339744831);       // 2π/8
    constexpr Scalar from_radians = numeric::from_real<Scalar>(0.63661977236758134);  // 4/2π
    constexpr Scalar third = numeric::from_real<Scalar>(1.0 / 3.0);
    constexpr Scalar foreseen = numeric::kept<Scalar>(0.25);
    const Scalar rotated = numeric::kept_product(measured.sine, cosine_) -
                           numeric::kept_product(measured.cosine, sine_);
    const Scalar pull = numeric::clamp_magnitude(
        numeric::multiplied(numeric::rough_product(numeric::kept_of(amplitude), rate_),
                            measured.inverse),
        whole());
    const Scalar innovation = rotated - numeric::kept_product(radians, beside) +
                              numeric::kept_product(pull, measured.sine);
    const Scalar change =
        numeric::rough_product(numeric::rough_product(natural_gain_, innovation), from_radians);
    take_natural(natural_ + numeric::scale_by_power_of_two(change, 1 + kept_bits));
    if (parameters_.natural_gain < natural_gain_) {
      natural_gain_ = numeric::max(
          parameters_.natural_gain,
          natural_gain_ -
              numeric::rough_product(numeric::rough_product(natural_gain_, natural_gain_), third));
    }
    if (numeric::abs(innovation) < foreseen) {
      return true;
    }
    natural_gain_ = numeric::max(natural_gain_, numeric::from_real<Scalar>(0.25));
    return false;
  }

  bool follow_growth(const numeric::Polar<Scalar>& measured, Scalar amplitude) {
    const Scalar drive = surplus(amplitude, measured.cosine, modulus_);
    const Scalar innovation = numeric::kept_difference(measured.modulus - modulus_, gained(drive));
    const Scalar missed = numeric::multiplied(innovation, inverse_rate_);
    if (parts_from_losses(numeric::kept_of(drive)) &&
        parts_from_losses(numeric::kept_sum(drive, missed))) {
      correct_rate(drive * missed);
    } else if (parameters_.audible < modulus_) {
      const Scalar noise = numeric::clamp_magnitude(missed, unrest_);
      const Scalar counted =
          missed - noise + numeric::rough_product(parameters_.quiet_losses, noise);
      correct_losses(numeric::multiplied(counted, measured.inverse));
    }
    return numeric::abs(missed) <= surprise_;
  }

  /// Whether a wrong h would hardly show in it, and noise would not.
  /// @param drive  beyond the losses, kept twice
  bool parts_from_losses(Scalar drive) const {
    constexpr Scalar most = numeric::kept_of(numeric::kept<Scalar>(0.98));
    if (!(numeric::kept_of(unrest_) < numeric::abs(drive))) {
      return false;
    }
    const Scalar losses = numeric::scale_by_power_of_two(holding(modulus_), 2 - 2 * kept_bits);
    return numeric::min(most, losses) < numeric::abs(drive);
  }

  /// @param gradient  surplus, kept, times missed drive, kept
  void correct_rate(Scalar gradient) {
    constexpr Scalar most = numeric::from_real<Scalar>(0.125);
    constexpr Scalar least_factor = numeric::from_real<Scalar>(0.0625);
    const Scalar part = numeric::twice(numeric::clamp_magnitude(rate_gain_ * gradient, most));
    const Scalar room = whole() - rate_factor_;
    rate_factor_ =
        numeric::max(least_factor, rate_factor_ + numeric::min(room, rate_factor_ * part));
    take_rate();
  }

  void take_rate() {
    const auto rate = numeric::product(nominal_rate_, numeric::floating(rate_factor_));
    const auto one_half = numeric::floating(numeric::from_real<Scalar>(0.5));
    rate_ = numeric::limited_value(rate);
    inverse_rate_ =
        numeric::multiple(numeric::rescaled(numeric::quotient(one_half, rate), 1 + kept_bits));
  }

  /// @param part  missed drive over the velocity, kept
  void correct_losses(Scalar part) {
    constexpr Scalar least = on_base(numeric::from_real<Scalar>(0x1p-20), losses_bits);
    constexpr Scalar most = on_base(numeric::from_real<Scalar>(0.999), losses_bits);
    losses_ = numeric::clamp(losses_ - numeric::rough_product(losses_gain_, part), least, most);
  }

  Parameters parameters_;
  numeric::Floating<Scalar> nominal_rate_;  ///< of kept numbers, as rate_; a quarter of q
  Scalar rate_gain_;
  Scalar losses_gain_;
  Scalar surprise_;
  Scalar unrest_;
  Scalar rate_{};                             ///< q of kept numbers: 2q in fixed point
  numeric::Multiple<Scalar> inverse_rate_{};  ///< 1/q
  Scalar rate_factor_{};                      ///< q over its nominal value, base 4
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
