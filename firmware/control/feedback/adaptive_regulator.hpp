/// Integral feedback whose gain falls while the friction ratio swings about its target.
#pragma once

#include <cstdint>

#include "firmware/control/feedback/integral_regulator.hpp"
#include "firmware/control/interface/part_name.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// As IntegralRegulator, with a gain g that follows the signs of the error: for a natural mode beside a
/// multiple of the carrier, at which the friction ratio may answer the drive more steeply than the inverse
/// map tells, and otherwise from one time to the next.
///
/// An error e counts where |e| > small_error. One whose sign is another than that of the last that counted is a
/// swing:
///   swing:                                      g' = max(least_gain, shrink g)
///   the same sign, patience times in a row:     g' = min(gain, g + growth g)
///   other periods, and while the integral is held:  g' = g
/// A changed target that holds the integral gives it the whole gain again.
///
/// This is the step length of Kesten's stochastic approximation (Kesten 1958, ../README.md): an error that
/// keeps its sign is far from its zero, one that changes it is about there. An error after a jump or a drift of
/// the friction keeps its sign, so that it is corrected with the whole gain soon.
///
/// With least_gain = gain the commands are those of an IntegralRegulator, bit for bit.
///
/// @tparam MaxDelay  see IntegralRegulator
template <class Scalar, int MaxDelay>
class AdaptiveRegulator : public IntegralRegulator<Scalar, MaxDelay> {
  using Integral = IntegralRegulator<Scalar, MaxDelay>;

 public:
  static constexpr PartName part_name{"feedback/adaptive_regulator", "AdaptiveRegulator"};
  struct Parameters : Integral::Parameters {
    Scalar least_gain;       ///< per carrier period; in (0, gain]
    Scalar shrink;           ///< in (0, 1)
    Scalar growth;           ///< in (0, 1)
    Scalar small_error;      ///< of a friction ratio, on base 2; > 0
    std::uint16_t patience;  ///< periods

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      Integral::Parameters::fields(self, visit);
      visit("least_gain", self.least_gain);
      visit("shrink", self.shrink);
      visit("growth", self.growth);
      visit("small_error", self.small_error);
      visit("patience", self.patience);
    }
  };

  explicit AdaptiveRegulator(const Parameters& parameters)
      : Integral(parameters),
        least_gain_(parameters.least_gain),
        shrink_(parameters.shrink),
        growth_(parameters.growth),
        small_error_(parameters.small_error),
        patience_(parameters.patience),
        full_gain_(parameters.gain) {}

  void restart(Scalar target) {
    Integral::restart(target);
    restore();
  }

  bool target_changes(Scalar change) {
    const bool holds = Integral::target_changes(change);
    if (holds) {
      restore();
    }
    return holds;
  }

  void accept(bool at_most_drive, bool at_least_drive) {
    if (!Integral::held()) {
      adapt(Integral::error());
    }
    Integral::accept(at_most_drive, at_least_drive);
  }

  /// That of the next proposal.
  Scalar gain() const { return Integral::gain(); }

 private:
  /// The whole gain, and no error that has counted.
  void restore() {
    Integral::set_gain(full_gain_);
    counted_ = Scalar{};
    alike_ = 0;
  }

  void adapt(Scalar error) {
    if (numeric::abs(error) <= small_error_) {
      return;
    }
    const Scalar gain = Integral::gain();
    if ((counted_ < Scalar{}) != (error < Scalar{}) && counted_ != Scalar{}) {
      Integral::set_gain(numeric::max(least_gain_, numeric::rough_product(gain, shrink_)));
      alike_ = 0;
    } else if (alike_ < patience_) {
      ++alike_;
    } else {
      Integral::set_gain(numeric::min(full_gain_, gain + numeric::rough_product(gain, growth_)));
    }
    counted_ = error;
  }

  Scalar least_gain_;
  Scalar shrink_;
  Scalar growth_;
  Scalar small_error_;
  std::uint16_t patience_;
  Scalar full_gain_;
  Scalar counted_{};         ///< the last error that counted; 0: none since the whole gain
  std::uint16_t alike_ = 0;  ///< errors that counted, of one sign, up to patience
};

}  // namespace sonoglide::control
