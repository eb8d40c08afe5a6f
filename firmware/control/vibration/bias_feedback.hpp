/// A force that is constant over a carrier period, against the mean velocity of the mass.
#pragma once

#include <cstdint>

#include "firmware/control/interface/drive_command.hpp"
#include "firmware/numeric/floating.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

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
  void answer(Scalar mean_velocity, BiasedCommand<Scalar>& command) const {
    if (command.state == State::off || command.state == State::fault) {
      command.bias = {};
      return;
    }
    const Scalar largest = numeric::from_code<Scalar>(INT32_MAX);
    const Scalar wanted = numeric::limited_product(mean_velocity, gain_);
    command.bias = -numeric::clamp_magnitude(wanted, largest);
    if (largest <= numeric::abs(command.bias) && command.limit == Limit::none) {
      command.limit = Limit::bias;
      command.state = command.state == State::running ? State::limited : command.state;
    }
  }

 private:
  numeric::Floating<Scalar> gain_;
};

}  // namespace sonoglide::control
