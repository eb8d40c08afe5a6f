/// A force that is constant over a carrier period, against the mean velocity of the mass.
#pragma once

#include <cstdint>

#include "firmware/control/interface/drive_command.hpp"
#include "firmware/numeric/floating.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// No bias where the controller is off or in a fault.
template <class Scalar>
bool is_driving(const DriveCommand<Scalar>& command) {
  return runs(command.state);
}

/// Limits a bias to its range, and names the limit where a command has none.
template <class Scalar>
void set_bias(Scalar wanted, BiasedCommand<Scalar>& command) {
  if (!is_driving(command)) {
    command.bias = {};
    return;
  }
  const Scalar largest = numeric::from_code<Scalar>(INT32_MAX);
  command.bias = numeric::clamp_magnitude(wanted, largest);
  if (largest <= numeric::abs(command.bias) && command.limit == Limit::none) {
    command.limit = Limit::bias;
    command.state = command.state == State::running ? State::limited : command.state;
  }
}

/// a − b; in fixed point limited to its range, and within a unit of the last place, exact where one of them
/// is 0.
template <class Scalar>
Scalar limited_difference(Scalar a, Scalar b) {
  if constexpr (!numeric::is_fixed_point_v<Scalar>) {
    return a - b;
  } else if (a == Scalar{}) {
    return -numeric::clamp_magnitude(b, numeric::from_code<Scalar>(INT32_MAX));
  } else {
    return b == Scalar{} ? a : numeric::limited_lift(numeric::half_difference(a, b), 1);
  }
}

/// The bias that takes the friction of the target from the mass: b = F, F the mean friction force over a
/// carrier period that is expected (../vibration.md). So the friction does not move a slow mode when it
/// changes.
///
/// b: base its limit; F: base the sensor's full scale, with the sign of a sample.
template <class ScalarT>
class FrictionBalance {
 public:
  using Scalar = ScalarT;

  struct Parameters {
    numeric::Split<Scalar> per_force;  ///< bias that balances a friction force of 1, > 0

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("per_force", self.per_force);
    }
  };

  explicit FrictionBalance(const Parameters& parameters)
      : per_force_(numeric::floating(parameters.per_force)) {}

  /// One call for each step, with its answer. A sample that is not usable leaves what was expected.
  /// friction() is F.
  template <class Friction>
  void expect(const DriveCommand<Scalar>& command, const Friction& friction) {
    if (command.limit != Limit::bad_sample) {
      expected_ = friction();
    }
  }

  /// b, in [-1, 1] in fixed point.
  Scalar bias() const { return numeric::limited_product(expected_, per_force_); }

 private:
  numeric::Floating<Scalar> per_force_;
  Scalar expected_{};
};

/// The bias b = −γ v̄, v̄ the mean velocity of the vibration over a carrier period, limited to its range
/// and named there. γ is a damper (../vibration.md): in newtons b = −g m v̄/T.
///
/// b: base its limit; v̄: base of the sliding velocity. In Q31 a bias inside its range is off by at most
/// 2^max(e, 1) units of the last place, e the exponent of γ; nothing overflows.
template <class ScalarT>
class BiasFeedback {
 public:
  using Scalar = ScalarT;

  struct Parameters {
    numeric::Split<Scalar> gain;  ///< γ > 0

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("gain", self.gain);
    }
  };

  explicit BiasFeedback(const Parameters& parameters) : gain_(numeric::floating(parameters.gain)) {}

  /// Adds the bias to a command, and its limit where the command has none. 0 where the controller is
  /// off or in a fault.
  /// @param mean_velocity  v̄
  /// @param command        gets the bias
  /// @param balance        that it adds to, in [-1, 1]
  /// @return what is left of the bias without the balance, in [-1, 1]
  Scalar answer(Scalar mean_velocity, BiasedCommand<Scalar>& command, Scalar balance = {}) const {
    set_bias(limited_difference(balance, numeric::limited_product(mean_velocity, gain_)), command);
    return is_driving(command) ? limited_difference(command.bias, balance) : Scalar{};
  }

 private:
  numeric::Floating<Scalar> gain_;
};

}  // namespace sonoglide::control
