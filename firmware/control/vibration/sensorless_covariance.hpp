/// How certain an observer is of a natural mode that it observes in one number a period.
#pragma once

#include <cstdint>

#include "firmware/control/vibration/pair.hpp"
#include "firmware/numeric/floating.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/near_root.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// Covariance P of the errors of the mode w, of the constant o and of the frequency parameter p:
/// that of an extended Kalman filter (../README.md). In a period P' = F P Fᵀ + Q, F the slope of (w',
/// o, p) over (w, o, p). A reading that shows c·(w, o, p) with the variance R takes t tᵀ off P:
///   t = P c/√S,  S = c·P c + R,
/// and moves (w, o, p) by t e/√S, e what it shows beyond the forecast, e/√S limited to ±3. Q of the
/// mode grows with the mode, as what the model has wrong does. After a reading beyond the limit the
/// mode is as uncertain again as at the start, or more: something has knocked it.
///
/// In fixed point velocities are on a base of four to eight times the fastest sliding, on which a
/// mode of 1 is a velocity of 1 to 2: no number here reaches 1. Products are too small by less than
/// two units of the last place, which Q makes good. A variance above its `most`, as after a long
/// time without readings, has P quartered.
template <class Scalar>
class SensorlessCovariance {
 public:
  /// Variances.
  struct Parameters {
    Scalar mode_at_start;  ///< and what a knock adds
    Scalar mode_per_period;
    Scalar mode_swing;  ///< per period, of a mode of 1
    Scalar mode_at_most;
    Scalar offset_at_start;
    Scalar offset_per_period;
    Scalar offset_at_most;

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("mode_at_start", self.mode_at_start);
      visit("mode_per_period", self.mode_per_period);
      visit("mode_swing", self.mode_swing);
      visit("mode_at_most", self.mode_at_most);
      visit("offset_at_start", self.offset_at_start);
      visit("offset_per_period", self.offset_per_period);
      visit("offset_at_most", self.offset_at_most);
    }
  };

  /// One number each for w, o and p.
  struct State {
    Pair<Scalar> mode;
    Scalar offset;
    Scalar frequency_parameter;
  };

  explicit SensorlessCovariance(const Parameters& parameters) : parameters_(parameters) {
    restart();
  }

  void restart() {
    first_ = parameters_.mode_at_start;
    second_ = parameters_.mode_at_start;
    both_ = {};
    of_offset_ = {};
    of_frequency_ = {};
    offset_ = parameters_.offset_at_start;
    frequency_parameter_ = numeric::from_real<Scalar>(0.2);
    offset_and_frequency_ = {};
  }

  /// What the map has wrong is another at another ratio: o is less certain by a part, in [0, 1], of
  /// what it is uncertain by at the start, and within its `most`.
  void inflate_offset(Scalar part) {
    offset_ = numeric::min(offset_ + times(part, parameters_.offset_at_start),
                           parameters_.offset_at_most);
  }

  /// @param rotation  d cos θ and d sin θ of A
  /// @param slope  of w' over p
  /// @param mode   w
  void predict(const Pair<Scalar>& rotation, const Pair<Scalar>& slope, const Pair<Scalar>& mode) {
    const Pair<Scalar> before = roughly_rotated(of_frequency_, rotation);
    of_frequency_ = before + slope * frequency_parameter_;
    of_offset_ = roughly_rotated(of_offset_, rotation) + slope * offset_and_frequency_;
    const Pair<Scalar> left = roughly_rotated({first_, both_}, rotation);
    const Pair<Scalar> right = roughly_rotated({both_, second_}, rotation);
    const Pair<Scalar> upper = roughly_rotated({left.first, right.first}, rotation);
    const Scalar lower = times(rotation.second, left.second) + times(rotation.first, right.second);
    const Scalar more = parameters_.mode_per_period +
                        times(parameters_.mode_swing,
                              times(mode.first, mode.first) + times(mode.second, mode.second));
    first_ = upper.first + times(slope.first, before.first + of_frequency_.first) + more;
    both_ =
        upper.second + times(slope.second, before.first) + times(slope.first, of_frequency_.second);
    second_ = lower + times(slope.second, before.second + of_frequency_.second) + more;
    offset_ = offset_ + parameters_.offset_per_period;
    frequency_parameter_ = frequency_parameter_ + numeric::from_real<Scalar>(1e-6);
    limit();
  }

  /// @param jacobian    c
  /// @param variance    R
  /// @param innovation  e
  /// @return what it moves; in fixed point limited to ±1
  State update(const State& jacobian, Scalar variance, Scalar innovation) {
    const State cross_covariance = product(jacobian);
    const Scalar sum = times(cross_covariance.mode.first, jacobian.mode.first) +
                       times(cross_covariance.mode.second, jacobian.mode.second) +
                       times(cross_covariance.offset, jacobian.offset) +
                       times(cross_covariance.frequency_parameter, jacobian.frequency_parameter) +
                       variance;
    const auto one_half = numeric::floating(numeric::from_real<Scalar>(0.5));
    const auto root = numeric::floating(numeric::near_root(numeric::max(sum, least)));
    const auto inverse = numeric::rescaled(numeric::quotient(one_half, root), 1);
    const State step{{numeric::limited_product(cross_covariance.mode.first, inverse),
                      numeric::limited_product(cross_covariance.mode.second, inverse)},
                     numeric::limited_product(cross_covariance.offset, inverse),
                     numeric::limited_product(cross_covariance.frequency_parameter, inverse)};
    constexpr double share = numeric::is_fixed_point_v<Scalar> ? 0.25 : 1.0;
    constexpr Scalar most = numeric::from_real<Scalar>(3.0 * share);
    take_off(step);
    const Scalar deviations =
        numeric::limited_product(numeric::from_real<Scalar>(share) * innovation, inverse);
    const Scalar part = numeric::clamp_magnitude(deviations, most);
    if (!(numeric::abs(deviations) < most)) {
      first_ = first_ + parameters_.mode_at_start;
      second_ = second_ + parameters_.mode_at_start;
    }
    const auto moved = [part](Scalar x) { return numeric::lifted(times(x, part), 2); };
    return {{moved(step.mode.first), moved(step.mode.second)},
            moved(step.offset),
            moved(step.frequency_parameter)};
  }

 private:
  /// Of S: in fixed point 64 units of the last place.
  static constexpr Scalar least = numeric::is_fixed_point_v<Scalar>
                                      ? numeric::from_code<Scalar>(64)
                                      : numeric::from_real<Scalar>(1e-18);

  static Scalar times(Scalar a, Scalar b) { return numeric::rough_product(a, b); }

  /// As rotated().
  static Pair<Scalar> roughly_rotated(const Pair<Scalar>& pair, const Pair<Scalar>& rotation) {
    return {times(rotation.first, pair.first) - times(rotation.second, pair.second),
            times(rotation.second, pair.first) + times(rotation.first, pair.second)};
  }

  /// P c
  State product(const State& jacobian) const {
    const Pair<Scalar>& mode = jacobian.mode;
    return {{times(first_, mode.first) + times(both_, mode.second) +
                 times(of_offset_.first, jacobian.offset) +
                 times(of_frequency_.first, jacobian.frequency_parameter),
             times(both_, mode.first) + times(second_, mode.second) +
                 times(of_offset_.second, jacobian.offset) +
                 times(of_frequency_.second, jacobian.frequency_parameter)},
            times(of_offset_.first, mode.first) + times(of_offset_.second, mode.second) +
                times(offset_, jacobian.offset) +
                times(offset_and_frequency_, jacobian.frequency_parameter),
            times(of_frequency_.first, mode.first) + times(of_frequency_.second, mode.second) +
                times(offset_and_frequency_, jacobian.offset) +
                times(frequency_parameter_, jacobian.frequency_parameter)};
  }

  /// t tᵀ
  void take_off(const State& t) {
    first_ = first_ - times(t.mode.first, t.mode.first);
    both_ = both_ - times(t.mode.first, t.mode.second);
    second_ = second_ - times(t.mode.second, t.mode.second);
    of_offset_ = of_offset_ - t.mode * t.offset;
    of_frequency_ = of_frequency_ - t.mode * t.frequency_parameter;
    offset_ = offset_ - times(t.offset, t.offset);
    offset_and_frequency_ = offset_and_frequency_ - times(t.offset, t.frequency_parameter);
    frequency_parameter_ =
        frequency_parameter_ - times(t.frequency_parameter, t.frequency_parameter);
  }

  void limit() {
    constexpr Scalar frequency_at_most = numeric::from_real<Scalar>(0.25);
    if (first_ < parameters_.mode_at_most && second_ < parameters_.mode_at_most &&
        offset_ < parameters_.offset_at_most && frequency_parameter_ < frequency_at_most) {
      return;
    }
    constexpr Scalar quarter = numeric::from_real<Scalar>(0.25);
    for (Scalar* const variance :
         {&first_, &both_, &second_, &of_offset_.first, &of_offset_.second, &of_frequency_.first,
          &of_frequency_.second, &offset_, &offset_and_frequency_, &frequency_parameter_}) {
      *variance = *variance * quarter;
    }
  }

  Parameters parameters_;
  Scalar first_{};  ///< of w, with itself
  Scalar both_{};
  Scalar second_{};
  Pair<Scalar> of_offset_;     ///< of w with o
  Pair<Scalar> of_frequency_;  ///< of w with p
  Scalar offset_{};
  Scalar offset_and_frequency_{};
  Scalar frequency_parameter_{};
};

}  // namespace sonoglide::control
