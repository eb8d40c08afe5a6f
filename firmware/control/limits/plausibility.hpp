/// Supervision of a friction ratio that no contact can have.
#pragma once

#include <cstdint>

#include "firmware/control/interface/drive_command.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// Friction resists the sliding and vibration lowers it, so the true ratio is in [0, 1]. A measured
/// ratio outside (−0.15, 1.3) for longer than the sensor lags shows a sensor that is wired
/// backwards, has lost its zero, or measures something else.
///
/// If friction resisted the sliding before, pulls now, and the velocity has not changed by a code
/// since, the sliding has turned and the velocity did not show it: a velocity sensor that stands
/// still. A force sensor that loses its zero by more than the friction looks the same.
template <class Scalar>
class Plausibility {
 public:
  struct Parameters {
    std::uint16_t periods;  ///< in a row that are granted, >= 1

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("periods", self.periods);
    }
  };

  static constexpr Scalar lowest() { return numeric::from_real<Scalar>(-0.075); }  ///< base 2
  static constexpr Scalar highest() { return numeric::from_real<Scalar>(0.65); }   ///< base 2

  explicit Plausibility(const Parameters& parameters) : parameters_(parameters) {}

  void restart() {
    outside_ = 0;
    velocity_ = {};
  }

  /// One call for each reading at a sliding that is fast enough.
  /// @param half_ratio  measured friction ratio on base 2
  /// @param velocity    of the same sample, not 0
  /// @return none, or once more readings in a row than are granted were outside: velocity_stuck where friction
  ///         pulls at the very velocity at which it resisted, else measurement_implausible
  Fault judge(Scalar half_ratio, Scalar velocity) {
    if (numeric::likely(numeric::is_below(half_ratio, highest()) ||
                        (lowest() < half_ratio && half_ratio <= Scalar{}))) {
      outside_ = 0;
      velocity_ = velocity;
      return Fault::none;
    }
    if (outside_ < parameters_.periods) {
      ++outside_;
      return Fault::none;
    }
    return half_ratio < Scalar{} && velocity == velocity_ ? Fault::velocity_stuck
                                                          : Fault::measurement_implausible;
  }

 private:
  Parameters parameters_;
  std::uint16_t outside_ = 0;
  Scalar velocity_{};  ///< of the last plausible reading; 0: none since restart
};

}  // namespace sonoglide::control
