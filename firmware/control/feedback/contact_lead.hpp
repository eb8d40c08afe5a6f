/// A contact that follows the drive slowly is driven beyond its target until it is there.
#pragma once

#include "firmware/control/interface/part_name.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// Under a vibration of which a contact forgets little in a carrier period, its mean friction ratio ρ follows
/// the commanded one ρc as
///   dρ/dt = (1 − ρ/ρc)/tp,   tp = Fc/(Kt |Vt|), the time in which it slides through its presliding distance:
/// with the time constant τ = ρ* tp at the target ρ*. Added to the ratio that a regulator commands,
///   lead ρ* (ρ* − ρ),   lead = g tp/T,
/// is the proportional part of a controller whose zero is on that pole, 1/τ: behind it the loop is that of a
/// prompt contact with an integrator of the gain g, and the error decays by a part g in each period, as long as
/// the command stays in [0, 1], to which it is limited (../README.md#a-slow-contact).
///
/// Ratios on base 2. In fixed point the sum is limited and nothing overflows beyond what the regulator's error does;
/// what is added is too small by less than 2^(e + 2) units of the last place, e the lead's exponent.
///
/// @tparam RegulatorT  NoFeedback | IntegralRegulator | AdaptiveRegulator; its reference must expect what the lead
///                     does. With a lead of 0 the commands are the regulator's, bit for bit.
template <class RegulatorT>
class ContactLead : public RegulatorT {
 public:
  using Scalar = typename RegulatorT::Scalar;
  static constexpr PartName part_name{"feedback/contact_lead", "ContactLead"};

  struct Parameters {
    [[no_unique_address]] typename RegulatorT::Parameters regulator;
    numeric::Split<Scalar> lead;  ///< twice the lead; 0, or at least 1/2

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("regulator", self.regulator);
      visit("lead", self.lead);
    }
  };

  static constexpr void scale_gain(Parameters& parameters, Scalar factor) {
    RegulatorT::scale_gain(parameters.regulator, factor);
    parameters.lead.mantissa *= factor;
  }

  explicit ContactLead(const Parameters& parameters)
      : RegulatorT(parameters.regulator), lead_(parameters.lead) {}

  /// See IntegralRegulator.
  Scalar propose(Scalar target, Scalar measured) {
    const Scalar ratio = RegulatorT::propose(target, measured);
    const Scalar error = numeric::rough_product(target, target - measured);
    const Scalar more =
        numeric::limited_lift(numeric::rough_product(error, lead_.mantissa), lead_.exponent);
    return ratio + numeric::clamp(more, -ratio, numeric::from_real<Scalar>(0.5) - ratio);
  }

 private:
  numeric::Split<Scalar> lead_;
};

}  // namespace sonoglide::control
