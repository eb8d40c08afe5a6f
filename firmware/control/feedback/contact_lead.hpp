/// A contact that follows the drive slowly is driven beyond its target until it is there.
#pragma once

#include "firmware/control/interface/part_name.hpp"
#include "firmware/control/interface/ratio.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// The mean of Dahl's equation over a carrier period: the friction ratio ρ of a contact that forgets little in a
/// period follows the commanded ratio ρc as
///   dρ/dt = (1 − ρ/ρc)/tp,   tp = Fc/(Kt |Vt|), the time in which it slides through its presliding distance,
/// near the target ρ* with the time constant τ = ρ* tp. Added to the ratio that a regulator commands is
///   lead ρ* (ρ* − ρ),   lead = g tp/T,
/// g being the loop's integral gain per period T. Integral and lead together are a proportional-integral controller
/// whose zero cancels the contact's pole −1/τ. The error after a new target decays at the rate 1/τ + g/T, while the
/// command is within [0, 1], to which it is limited (../README.md#a-slow-contact).
///
/// Ratios on base 2. In fixed point the lead's part is too small by less than 2^(exponent + 2) units of the last place,
/// and nothing overflows that does not without it.
///
/// @tparam RegulatorT  NoFeedback | IntegralRegulator, whose reference expects what the lead does. With a lead of 0 the
///                     commands are the regulator's, bit for bit.
template <class RegulatorT>
class ContactLead : public RegulatorT {
 public:
  using Scalar = typename RegulatorT::Scalar;
  static constexpr PartName part_name{"feedback/contact_lead", "ContactLead"};

  struct Parameters {
    [[no_unique_address]] typename RegulatorT::Parameters regulator;
    numeric::Split<Scalar> lead;  ///< twice the lead [-]: 0, or from 1/2 to 2^11

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
    return ratio + numeric::clamp(more, -ratio, whole_ratio<Scalar> - ratio);
  }

 private:
  numeric::Split<Scalar> lead_;
};

}  // namespace sonoglide::control
