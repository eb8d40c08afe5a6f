/// Friction under a normal force that vibrates, inside a step of the Taylor method.
#pragma once

#include <cstddef>
#include <limits>

#include "firmware/numeric/first_root.hpp"
#include "firmware/numeric/power_series.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::plant {

/// The slider's motion from one instant on, and its end: it sticks, slips, or is lifted off.
///
/// Two margins decide: that of the pressure above 0 and, for a slider that sticks, that of the
/// limit above the force. Of each the first coefficient counts that exceeds its rounding error. A
/// motion ends at the first root of a margin; a slip also ends where the rate at which the margin
/// would open passes zero. No root is passed over.
template <class Law, class Series>
class NormalPiece {
 public:
  using Scalar = typename Series::Scalar;
  using Coefficients = typename Series::Coefficients;

  /// series: of the motion, which does not depend on the friction. friction: at its beginning.
  NormalPiece(const Law& law, const Series& series, Scalar friction) : law_(law), series_(series) {
    for (std::size_t n = 0; n <= order; ++n) {
      pressure_[n] = law.normal_stiffness * series.state_coefficients(n).displacement;
    }
    pressure_[0] += Scalar(1);
    const Scalar limit = law.limit(series.displacement);
    const Scalar pull = law.contact_stiffness * series.unit;
    pulled_[0] = numeric::clamp(friction, -limit, limit);
    pulled_[1] = pull * series.sliding_velocity[0];
    pulled_[2] = numeric::half(pull * series.sliding_velocity[1]);
    choose();
  }

  /// The coefficients of phi.
  Coefficients friction() const {
    Coefficients friction{};
    for (std::size_t n = 0; n <= order; ++n) {
      friction[n] = motion_ == Motion::sticks ? pulled_[n] : direction_ * pressure_[n];
    }
    return friction;
  }

  /// Where the motion ends, or `longest`.
  Scalar end(Scalar longest) const {
    switch (motion_) {
      case Motion::lifted:
        return root(pressure_, {Scalar(-1), pressure_order_}, longest);
      case Motion::slips:
        return slip_end(root(pressure_, {Scalar(1), pressure_order_}, longest));
      case Motion::sticks:
        break;
    }
    const Scalar forwards = root(margin(Scalar(1)), {Scalar(1), forward_order_}, longest);
    return root(margin(Scalar(-1)), {Scalar(1), backward_order_}, forwards);
  }

 private:
  static constexpr std::size_t order = Series::order;

  enum class Motion { sticks, slips, lifted };

  /// The first coefficient of a polynomial that is not a rounding error.
  struct Leading {
    Scalar sign;        ///< 0 if there is none
    std::size_t power;  ///< then order + 1
  };

  void choose() {
    const Leading pressure = leading(pressure_, 0);
    pressure_order_ = pressure.power;
    if (!(pressure.sign > Scalar(0))) {
      motion_ = Motion::lifted;
      return;
    }
    for (const Scalar direction : {Scalar(1), Scalar(-1)}) {
      const Leading above = leading(margin(direction), 0);
      if (above.sign < Scalar(0)) {
        motion_ = Motion::slips;
        direction_ = direction;
        slip_order_ = above.power > 0 ? above.power - 1 : 0;
        return;
      }
      (direction > Scalar(0) ? forward_order_ : backward_order_) = above.power;
    }
  }

  Leading leading(const Coefficients& p, std::size_t first) const {
    Scalar largest = Scalar(0);
    for (std::size_t n = 0; n <= order; ++n) {
      largest += numeric::abs(pressure_[n]) + numeric::abs(pulled_[n]);
    }
    const Scalar error = rounding * largest;
    for (std::size_t n = first; n <= order; ++n) {
      if (numeric::abs(p[n]) > error) {
        return {numeric::sign(p[n]), n};
      }
    }
    return {Scalar(0), order + 1};
  }

  /// Margin of the limit above the force in a direction, while the slider sticks.
  Coefficients margin(Scalar direction) const {
    Coefficients margin = pressure_;
    for (std::size_t n = 0; n < 3; ++n) {
      margin[n] -= direction * pulled_[n];
    }
    return margin;
  }

  /// Where the rate at which the margin would open rises from below 0.
  Scalar slip_end(Scalar longest) const {
    const Coefficients above = margin(direction_);
    Coefficients rate{};
    for (std::size_t n = 0; n < order; ++n) {
      rate[n] = static_cast<Scalar>(n + 1) * above[n + 1];
    }
    return root(rate, {Scalar(-1), slip_order_}, longest);
  }

  static Scalar root(const Coefficients& p, const Leading& from, Scalar longest) {
    return from.power > order
               ? longest
               : numeric::first_root(numeric::without_zero(p, from.sign, from.power), longest);
  }

  /// A root is found within some roundings of the terms about it.
  static constexpr Scalar rounding = Scalar(128) * std::numeric_limits<Scalar>::epsilon();

  const Law& law_;
  const Series& series_;
  Coefficients pressure_{};  ///< N / N0, without its cut at 0
  Coefficients pulled_{};    ///< phi while it sticks
  Motion motion_ = Motion::sticks;
  Scalar direction_ = Scalar(0);  ///< in which it slips
  std::size_t pressure_order_ = 0;
  std::size_t forward_order_ = 0;
  std::size_t backward_order_ = 0;
  std::size_t slip_order_ = 0;
};

/// The friction of a piece, given by the series.
template <class Law, class Series>
class NormalFriction {
 public:
  using Scalar = typename Series::Scalar;

  NormalFriction(const Law& law, const Series& series) : law_(law), series_(series) {}

  Scalar at(Scalar x) const {
    const Scalar limit = law_.limit(series_.displacement_at(x));
    return numeric::clamp(numeric::evaluate(series_.friction, x), -limit, limit);
  }
  /// Work of the pull, which all goes into the contact.
  Scalar work(Scalar x) const {
    return series_.unit *
           (series_.sliding_velocity[0] * integral(x) + series_.sliding_velocity[1] * moment(x));
  }
  Scalar integral(Scalar extent) const { return numeric::integrate(series_.friction, extent); }
  Scalar moment(Scalar extent) const { return numeric::first_moment(series_.friction, extent); }

 private:
  const Law& law_;
  const Series& series_;
};

}  // namespace sonoglide::plant
