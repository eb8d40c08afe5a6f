/// Feedforward for a Dahl contact.
#pragma once

#include "firmware/control/friction/friction_level.hpp"
#include "firmware/control/interface/part_name.hpp"
#include "firmware/friction/dahl_inverse_map.hpp"
#include "firmware/numeric/floating.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// Inverse Dahl map at λ = Kt·Vt/(ω·Fc), the travel of the sliding per radian of the carrier over
/// the presliding distance.
template <class ScalarT>
class DahlFeedforward {
 public:
  static constexpr PartName part_name{"friction/dahl_feedforward", "DahlFeedforward"};
  using Scalar = ScalarT;

  struct Parameters {
    /// Kt·X̂ / force full scale, X̂ the vibration amplitude at full drive.
    numeric::Split<Scalar> contact_force;

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("contact_force", self.contact_force);
    }
  };

  explicit DahlFeedforward(const Parameters& parameters) : parameters_(parameters) {}
  static constexpr void settle_at(const Parameters& /*parameters*/) {}

  void set_friction(const FrictionLevel<Scalar>& friction) {
    const numeric::Split<Scalar>& force = parameters_.contact_force;
    half_travel_ = numeric::quotient(
        numeric::floating(numeric::Split<Scalar>{force.mantissa, force.exponent - 1}),
        friction.level());
  }

  /// Drive amplitude in [0, 1] at which the friction ratio is reached; the largest value where none
  /// does.
  /// @param half_ratio  friction ratio on base 2, in [0, 1/2].
  /// @param speed       |Vt|, base the peak vibration velocity at full drive; > 0.
  Scalar amplitude(Scalar half_ratio, Scalar speed) const {
    return friction::dahl_vibration_velocity(half_ratio, speed, half_travel_);
  }

 protected:
  const numeric::Floating<Scalar>& half_travel() const { return half_travel_; }

 private:
  Parameters parameters_;
  numeric::Floating<Scalar> half_travel_{};  ///< λ/2 at a speed of 1
};

/// The same for a contact stiffness and a gain, true over nominal vibration velocity, that are learnt
/// while driving.
template <class ScalarT>
class TrackedDahlFeedforward : public DahlFeedforward<ScalarT> {
  using Base = DahlFeedforward<ScalarT>;

 public:
  static constexpr PartName part_name{"friction/dahl_feedforward", "TrackedDahlFeedforward"};
  using Scalar = ScalarT;
  using Base::Base;

  /// @param friction      Fc that is learnt
  /// @param contact       Kt g, over the nominal one
  /// @param inverse_gain  1/g
  void set_friction(const FrictionLevel<Scalar>& friction, const numeric::Floating<Scalar>& contact,
                    const numeric::Floating<Scalar>& inverse_gain) {
    Base::set_friction(friction);
    tracked_travel_ = numeric::product(Base::half_travel(), contact);
    inverse_gain_ = inverse_gain;
  }

  /// As that of DahlFeedforward.
  Scalar amplitude(Scalar half_ratio, Scalar speed) const {
    return amplitude_at(half_ratio, speed, tracked_travel_);
  }

  /// The same for a contact whose stiffness is stiffer() times as large.
  Scalar stiffer_amplitude(Scalar half_ratio, Scalar speed) const {
    const auto part = numeric::floating(numeric::from_real<Scalar>(0.5 * stiffer()));
    return amplitude_at(half_ratio, speed,
                        numeric::rescaled(numeric::product(tracked_travel_, part), 1));
  }
  static constexpr double stiffer() { return 1.25; }

 private:
  Scalar amplitude_at(Scalar half_ratio, Scalar speed,
                      const numeric::Floating<Scalar>& half_travel) const {
    return friction::dahl_vibration_velocity(
        half_ratio, numeric::limited_product(speed, inverse_gain_), half_travel);
  }

  numeric::Floating<Scalar> tracked_travel_{};
  numeric::Floating<Scalar> inverse_gain_{};
};

}  // namespace sonoglide::control
