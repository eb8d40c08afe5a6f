/// Friction force, contact stiffness and gain of the vibration, as readings tell of them.
#pragma once

#include "firmware/numeric/floating.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/near_root.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// An extended Kalman filter (Anderson 1979, ../README.md) of three constants: the logarithms of Fc,
/// of the contact stiffness Kt and of the gain g (true over nominal vibration velocity). A mean force
/// F = Fc ρ(Vt/v̂, κ) at a steady drive shows
///   ln F = ln Fc + ln ρ,  h = d ln F / d (ln Fc, ln Kt, ln g) = (1 − s, s, w),
/// s = ∂ln ρ/∂ln Kt and w = ∂ln ρ/∂ln v̂, both in [-1, 0]. With the covariance P, the innovation e and
/// the variance R of a reading
///   S = h·P h + R,  t = P h/√S,  x' = x + t e/√S,  P' = P − t tᵀ.
/// R has the variance of a reading, and (|s| var(ln Kt) + |w| var(ln g))² for the second order, which
/// the filter leaves out. So readings that are taken far from the truth do not make it certain.
///
/// A reading beyond three deviations, |e| > 3 √S, shows that the friction has changed: Fc is then less
/// certain by e², and R has (|s| e²/2)² more. If it is one of the first at a request, it may as well be
/// that Kt or g is another than was known at the start. There two deviations are the bound, because R keeps
/// the innovations of a start that is right far below one. Kt and g become as uncertain as at the start, g by
/// e² more, and by 0.125² at least: Kt is so uncertain that an error of g leaves little of itself in e.
/// Each reading that is taken in makes every constant less certain by 0.002, so that no constant is ever
/// known for good.
///
/// All are of the order of 1 or below. In fixed point nothing reaches 1: readings are taken by halves
/// (h/2, e/2, R/4, S/4), and variances are at most 1/2. Products are too small by less than two units
/// of the last place, 2^-30, against 2^-18 that a reading adds.
template <class Scalar>
class FrictionEstimate {
 public:
  /// Variances at the start.
  struct Parameters {
    Scalar force;
    Scalar stiffness;
    Scalar gain;

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("force", self.force);
      visit("stiffness", self.stiffness);
      visit("gain", self.gain);
    }
  };

  /// A number for each of ln Fc, ln Kt and ln g.
  struct Each {
    Scalar force;
    Scalar stiffness;
    Scalar gain;
  };

  /// Halves: of h, of a reading's deviation and of its innovation.
  struct Reading {
    Each slope;
    Scalar deviation;
    Scalar innovation;
  };

  explicit FrictionEstimate(const Parameters& parameters) : parameters_(parameters) { restart(); }

  void restart() {
    contradicted_ = false;
    forget();
  }

  /// What is known is that of the start, but that Kt or g as they were there may have been contradicted.
  void forget() {
    variance_ = {parameters_.force, parameters_.stiffness, parameters_.gain};
    if (contradicted_) {
      variance_.gain = numeric::max(variance_.gain, unknown_gain());
    }
    force_stiffness_ = {};
    force_gain_ = {};
    stiffness_gain_ = {};
  }

  /// Of ln Fc, ln Kt and ln g.
  const Each& variance() const { return variance_; }

  /// The same of Fc; of Kt and g for a gain that may be another than was known at the start. With P0 the
  /// variance of ln g there, an error ε of it is left in what the readings have made of ln x (Schmidt 1966,
  /// ../README.md):
  ///   cov(ln x, ln g)/P0 ε,  at most 0.7, ε of a standard deviation of 0.11.
  /// 0.11 holds a gain that is 15 % off, and a little more for what is not linear in it.
  Each stated_variance() const {
    constexpr Scalar unforeseen = numeric::from_real<Scalar>(0.11);
    const auto share =
        numeric::quotient(numeric::floating(unforeseen), numeric::floating(parameters_.gain));
    const auto left = [&](Scalar covariance) {
      constexpr Scalar most = numeric::from_real<Scalar>(0.7);
      const Scalar error =
          numeric::clamp_magnitude(numeric::limited_product(covariance, share), most);
      return times(error, error);
    };
    const Scalar of_start = numeric::min(variance_.gain, parameters_.gain);
    return {variance_.force, limited(variance_.stiffness + left(stiffness_gain_)),
            limited(variance_.gain + left(of_start))};
  }

  /// The most that a variance may be.
  static constexpr Scalar most_variance() { return numeric::from_real<Scalar>(0.5); }

  /// Readings at different requests have contradicted Kt or g as they were at the start.
  bool contradicted() const { return contradicted_; }

  /// Fc is less certain.
  void widen(Scalar variance) { variance_.force = limited(variance_.force + variance); }

  /// Weighs a reading.
  /// @param reading  its slope, deviation and innovation, by halves
  /// @param wanted  take it in where it shows nothing new, too
  /// @param elsewhere  it is one of the first at a request
  /// @return false: it is not taken in
  bool weigh(const Reading& reading, bool wanted, bool elsewhere) {
    constexpr Scalar quarter = numeric::from_real<Scalar>(1.0 / 4.0);
    constexpr Scalar ninth = numeric::from_real<Scalar>(1.0 / 9.0);
    const Scalar square = times(reading.innovation, reading.innovation);
    gain_ = product(reading.slope);
    const Scalar neglected = second_order(reading.slope);
    const bool changed = sum(reading, neglected) < times(elsewhere ? quarter : ninth, square);
    if (!changed && !wanted) {
      return false;
    }
    age();
    if (changed) {
      const Scalar most = numeric::min(square, numeric::from_real<Scalar>(0.1));
      const Scalar whole = numeric::twice(numeric::twice(most));
      widen(whole);
      if (elsewhere) {
        contradicted_ = true;
        variance_.stiffness = limited(numeric::max(variance_.stiffness, parameters_.stiffness));
        variance_.gain = limited(numeric::max(variance_.gain, parameters_.gain) +
                                 numeric::max(whole, unknown_gain()));
      }
    }
    const Scalar bent = changed ? times(reading.slope.stiffness, numeric::twice(square)) : Scalar{};
    gain_ = product(reading.slope);
    scale(sum(reading, neglected - bent), reading.innovation);
    residual_ = reading.innovation -
                numeric::lifted(times(dot(gain_, reading.slope), deviations_), share_bits);
    return true;
  }

  /// Takes in the reading that was weighed last.
  /// @return the halves of what it moves, limited to ±1/2
  Each take() {
    take_off(gain_);
    const auto moved = [this](Scalar x) {
      constexpr Scalar most = numeric::from_real<Scalar>(0.5);
      return numeric::clamp_magnitude(
          numeric::half(numeric::lifted(times(x, deviations_), share_bits)), most);
    };
    return {moved(gain_.force), moved(gain_.stiffness), moved(gain_.gain)};
  }

  /// Half of the innovation that the constants, moved by the reading weighed last, leave.
  Scalar residual() const { return residual_; }

 private:
  static constexpr int share_bits = 2;  ///< e/√S is kept by quarters in fixed point
  /// Of S/4: in fixed point 64 units of the last place.
  static constexpr Scalar least = numeric::is_fixed_point_v<Scalar>
                                      ? numeric::from_code<Scalar>(64)
                                      : numeric::from_real<Scalar>(1e-12);

  static Scalar times(Scalar a, Scalar b) { return numeric::rough_product(a, b); }
  static Scalar dot(const Each& a, const Each& b) {
    return times(a.force, b.force) + times(a.stiffness, b.stiffness) + times(a.gain, b.gain);
  }
  /// Variance of ln g where its start is contradicted.
  static constexpr Scalar unknown_gain() { return numeric::from_real<Scalar>(1.0 / 64.0); }
  static Scalar limited(Scalar variance) { return numeric::min(variance, most_variance()); }

  /// P h
  Each product(const Each& h) const {
    return {
        dot({variance_.force, force_stiffness_, force_gain_}, h),
        dot({force_stiffness_, variance_.stiffness, stiffness_gain_}, h),
        dot({force_gain_, stiffness_gain_, variance_.gain}, h),
    };
  }

  /// Half of what the second order leaves out. @param h  its halves
  Scalar second_order(const Each& h) const {
    return -times(h.stiffness, variance_.stiffness) - times(h.gain, variance_.gain);
  }

  /// S/4, of the product in gain_.
  Scalar sum(const Reading& reading, Scalar neglected) const {
    return dot(gain_, reading.slope) + times(reading.deviation, reading.deviation) +
           times(neglected, neglected);
  }

  void age() {
    constexpr Scalar more = numeric::from_real<Scalar>(4e-6);
    variance_ = {limited(variance_.force + more), limited(variance_.stiffness + more),
                 limited(variance_.gain + more)};
  }

  /// t of the product P h, and e/√S.
  void scale(Scalar sum, Scalar innovation) {
    const auto one_half = numeric::floating(numeric::from_real<Scalar>(0.5));
    const auto root = numeric::floating(numeric::near_root(numeric::max(sum, least)));
    const auto inverse = numeric::rescaled(numeric::quotient(one_half, root), 1);
    gain_ = {numeric::limited_product(gain_.force, inverse),
             numeric::limited_product(gain_.stiffness, inverse),
             numeric::limited_product(gain_.gain, inverse)};
    constexpr double share = numeric::is_fixed_point_v<Scalar> ? 0.25 : 1.0;
    deviations_ = numeric::clamp_magnitude(
        numeric::limited_product(numeric::from_real<Scalar>(share) * innovation, inverse),
        numeric::from_real<Scalar>(3.5 * share));
  }

  void take_off(const Each& t) {
    variance_.force = variance_.force - times(t.force, t.force);
    variance_.stiffness = variance_.stiffness - times(t.stiffness, t.stiffness);
    variance_.gain = variance_.gain - times(t.gain, t.gain);
    force_stiffness_ = force_stiffness_ - times(t.force, t.stiffness);
    force_gain_ = force_gain_ - times(t.force, t.gain);
    stiffness_gain_ = stiffness_gain_ - times(t.stiffness, t.gain);
  }

  Parameters parameters_;
  Each variance_{};
  Scalar force_stiffness_{};  ///< covariances
  Scalar force_gain_{};
  Scalar stiffness_gain_{};
  Each gain_{};          ///< P h, then t
  Scalar deviations_{};  ///< e/√S; in fixed point a quarter of it
  Scalar residual_{};
  bool contradicted_ = false;
};

}  // namespace sonoglide::control
