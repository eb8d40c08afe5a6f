/// Integral feedback that learns by which factor the vibration is read wrong.
#pragma once

#include "firmware/control/feedback/integral_regulator.hpp"
#include "firmware/control/interface/part_name.hpp"
#include "firmware/control/interface/ratio.hpp"
#include "firmware/numeric/floating.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// wanted velocity = s V(commanded ratio), V the inverse map.
///
/// A motional current over a force factor that is off reads every velocity too large or too small
/// by one factor, at every target. In friction ratio that is another error at each target. So a
/// change of the target that holds the integral gives it up to the factor:
///   s' = s V(target + integral)/V(target) of the old target, in [1/2, 2); then the integral is 0.
/// The wanted velocity of the old target stays what it was, and that of the new one is right if the
/// factor alone was wrong.
///
/// @tparam MaxDelay  see IntegralRegulator
template <class Scalar, int MaxDelay>
class ScalingRegulator : public IntegralRegulator<Scalar, MaxDelay> {
  using Integral = IntegralRegulator<Scalar, MaxDelay>;

 public:
  static constexpr PartName part_name{"feedback/scaling_regulator", "ScalingRegulator"};
  struct Parameters : Integral::Parameters {
    bool scales;  ///< false: the commands of an IntegralRegulator, bit for bit

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      Integral::Parameters::fields(self, visit);
      visit("scales", self.scales);
    }
  };

  explicit ScalingRegulator(const Parameters& parameters)
      : Integral(parameters), scales_(parameters.scales) {}

  void restart(Scalar target) {
    Integral::restart(target);
    scale_ = one();
    inverse_ = one();
    target_ = target;
    commanded_ = target;
    pending_ = false;
  }

  void target_changes(Scalar change) { pending_ = Integral::target_changes(change) || pending_; }

  /// To be called before each propose(). @param velocity_of  V at the present sliding speed
  template <class VelocityOf>
  void learn_scale(const VelocityOf& velocity_of) {
    if (!pending_) {
      return;
    }
    pending_ = false;
    const Scalar nominal = scales_ ? velocity_of(target_) : Scalar{};
    const Scalar found = scales_ ? velocity_of(commanded_) : Scalar{};
    if (!(Scalar{} < nominal && Scalar{} < found)) {
      return;  // no drive, nothing to learn
    }
    const auto part = numeric::quotient(numeric::floating(found), numeric::floating(nominal));
    scale_ = numeric::clamp(
        numeric::limited_value(numeric::product(numeric::floating(scale_), part)), least(), most());
    inverse_ = numeric::limited_value(
        numeric::quotient(numeric::floating(least()), numeric::floating(scale_)));
    Integral::shift(target_, commanded_);
  }

  Scalar propose(Scalar target, Scalar measured) {
    target_ = target;
    commanded_ = Integral::propose(target, measured);
    return commanded_;
  }

  /// s V, at most 1.
  Scalar scaled(Scalar velocity) const {
    return scales_ ? numeric::limited_lift(numeric::rough_product(velocity, scale_), 1) : velocity;
  }

  /// About the ratio of which V is the scaled velocity, V being nearly proportional to 1/ratio.
  Scalar implied(Scalar ratio) const {
    return scales_ ? numeric::min(numeric::limited_lift(numeric::rough_product(ratio, inverse_), 1),
                                  whole_ratio<Scalar>)
                   : ratio;
  }

 private:
  // s and 1/s on base 2.
  static constexpr Scalar one() { return numeric::from_real<Scalar>(0.5); }
  static constexpr Scalar least() { return numeric::from_real<Scalar>(0.25); }
  static constexpr Scalar most() { return numeric::from_real<Scalar>(0.999); }

  bool scales_;
  Scalar scale_ = one();
  Scalar inverse_ = one();
  Scalar target_{};     ///< of the last proposal
  Scalar commanded_{};  ///< the proposal
  bool pending_ = false;
};

}  // namespace sonoglide::control
