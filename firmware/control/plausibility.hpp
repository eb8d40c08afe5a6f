/// Supervision of a friction ratio that no contact can have.
#pragma once

#include <cstdint>

#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// Friction resists the sliding and vibration lowers it, so the true ratio is in [0, 1]. A measured
/// ratio outside (−0.15, 1.3) for longer than the sensor lags shows a sensor that is wired
/// backwards, has lost its zero, or measures something else.
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

  void restart() { outside_ = 0; }

  /// One call for each reading at a sliding that is fast enough.
  /// @param half_ratio  measured friction ratio on base 2
  /// @return true once more readings in a row than are granted were outside
  bool implausible(Scalar half_ratio) {
    if (lowest() < half_ratio && half_ratio < highest()) {
      outside_ = 0;
      return false;
    }
    if (outside_ < parameters_.periods) {
      ++outside_;
      return false;
    }
    return true;
  }

 private:
  Parameters parameters_;
  std::uint16_t outside_ = 0;
};

}  // namespace sonoglide::control
