/// A friction force that changes slowly, followed between the readings of a FrictionEstimate.
#pragma once

#include "firmware/control/friction/half_logarithm.hpp"
#include "firmware/numeric/floating.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// Changes of ln Fc at a request that stays. What the map is wrong by is the same from reading to
/// reading there, so that a reading shows a change far smaller than the error of the map: its
/// innovation less the `base`, which is what the last reading taken in has left of its own.
///
/// An innovation i beyond the base, of a reading with noise c, shows an error of the Fc believed
///   d = i/(1 − s) · i²/(i² + 4c²).
/// With a, by which the belief was ahead of the reading before, Fc has changed by m = d + a since then.
/// The belief moves by d + a', where a' is the smaller one of m and the m before, at most 1/64, and 0 if
/// they have different signs. So a ramp is followed without a lag, and a jump is not continued. 1/64
/// from reading to reading is a friction that changes by half in 10 ms, at 60 kHz and 19 periods a reading.
///
/// Numbers are halves of logarithms, |.| < 1/2.
template <class Scalar>
class FrictionDrift {
 public:
  /// Readings of another request follow. @param base  of them
  void begin(Scalar base) {
    base_ = base;
    rest();
  }
  /// The same for a friction that goes on to change.
  void goes_on(Scalar base) { base_ = base; }
  /// The same for one whose change m is known. @return  by how much the belief moves
  Scalar begin_ahead(Scalar base) {
    base_ = base;
    ahead_ = change_;
    return ahead_;
  }

  /// m
  Scalar change() const { return change_; }
  void set_change(Scalar change) { change_ = numeric::clamp_magnitude(change, most()); }

  /// By how much Fc changes in two readings and the periods in which the request moves.
  /// @param moved  these, over 256; a reading has about 16
  Scalar change_over(Scalar moved) const {
    return numeric::twice(change_) + numeric::lifted(numeric::rough_product(change_, moved), 4);
  }

  /// What a reading shows beyond its base.
  Scalar shown(Scalar innovation) const { return innovation - base_; }
  Scalar base() const { return base_; }

  /// A reading shows nothing new.
  void rest() { change_ = ahead_ = {}; }

  /// Whether a reading is to move the belief.
  /// @param shown  beyond its base
  /// @param noise  c
  bool moves(Scalar shown, Scalar noise) const {
    return noise < numeric::abs(shown) || ahead_ != Scalar{};
  }

  /// d
  /// @param shown        beyond the base
  /// @param noise        c
  /// @param force_slope  (1 − s)/2
  static Scalar error(Scalar shown, Scalar noise, Scalar force_slope) {
    const Scalar square = numeric::rough_product(shown, shown);
    const Scalar doubt = numeric::twice(numeric::twice(numeric::rough_product(noise, noise)));
    const auto sure =
        numeric::quotient(numeric::floating(square),
                          numeric::floating(square + doubt + numeric::from_code<Scalar>(1)));
    return numeric::half(
        numeric::limited_product(numeric::limited_product(shown, sure), inverse_of(force_slope)));
  }

  /// @param error  d
  /// @return by how much the belief moves
  Scalar follow(Scalar error) {
    const Scalar change = error + ahead_;
    const bool same_way = (change < Scalar{}) == (change_ < Scalar{});
    const Scalar smaller = numeric::abs(change) < numeric::abs(change_) ? change : change_;
    ahead_ = same_way ? numeric::clamp_magnitude(smaller, most()) : Scalar{};
    change_ = change;
    return error + ahead_;
  }

  /// m²
  Scalar variance() const { return square_of_twice(change_); }

  /// (2x)² @param x  |.| < 1/4
  static Scalar square_of_twice(Scalar x) {
    return numeric::twice(numeric::twice(numeric::rough_product(x, x)));
  }

 private:
  static constexpr Scalar most() { return numeric::from_real<Scalar>(1.0 / 128.0); }

  Scalar base_{};
  Scalar change_{};  ///< m
  Scalar ahead_{};   ///< a
};

}  // namespace sonoglide::control
