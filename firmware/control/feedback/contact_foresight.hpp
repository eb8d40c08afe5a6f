/// A contact that follows the drive slowly is driven beyond its target for as long as a model of it tells.
#pragma once

#include "firmware/control/interface/part_name.hpp"
#include "firmware/control/interface/ratio.hpp"
#include "firmware/numeric/floating.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// In front of the contact of a drive that is fed forward. The friction ratio ρ of a contact that forgets little in a
/// carrier period follows the commanded ratio ρc by dρ/dt = (1 − ρ/ρc)/tp (see ContactLead). After a restart, and a new
/// target ρ* that holds the integral, the measured ratio is the start of a model m. From then on, per period T,
///   w  = (ρ* − m)/4, limited to what full drive and no drive give: (1 − m/ρl) T/tp <= w <= (1 − m) T/tp
///   ρc = m/(1 − w tp/T)   the command that moves the contact by w; ρl or 1 where w is at its limit
///   m' = m + w
/// so that the contact comes to its target by 1/4 of the rest in each period. No reading is fed back: what the
/// natural mode adds to a reading does not come back to the drive. To the regulator the model is the target, so that
/// its integral takes what the contact differs from the model by. To all that compare readings with commands the
/// command is the regulator's: a contact on its way shows the model, not ρc. Where ρ* < ρl, the command is at least ρ*.
///
/// Ratios on base 2. In fixed point 1 − w tp/T is off by less than 2^(exponent + 6) units of the last place, and
/// nothing overflows that does not without it.
///
/// @tparam RegulatorT  IntegralRegulator | AdaptiveRegulator. With a rise of 0 the commands are the regulator's, bit
///                     for bit; so they are while the model is at its target.
template <class RegulatorT>
class ContactForesight : public RegulatorT {
 public:
  using Scalar = typename RegulatorT::Scalar;
  static constexpr PartName part_name{"feedback/contact_foresight", "ContactForesight"};

  struct Parameters {
    [[no_unique_address]] typename RegulatorT::Parameters regulator;
    Scalar rise;                        ///< T/tp, in (0, 1/4]; 0: a prompt contact
    Scalar fall;                        ///< min(T/(tp ρl), 1/4)
    Scalar least;                       ///< ρl that full drive gives; at least 1/8
    numeric::Split<Scalar> presliding;  ///< tp/(8 T), from 1/2 to 2^7

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("regulator", self.regulator);
      visit("rise", self.rise);
      visit("fall", self.fall);
      visit("least", self.least);
      visit("presliding", self.presliding);
    }
  };

  static constexpr void scale_gain(Parameters& parameters, Scalar factor) {
    RegulatorT::scale_gain(parameters.regulator, factor);
  }

  explicit ContactForesight(const Parameters& parameters)
      : RegulatorT(parameters.regulator),
        rise_(parameters.rise),
        fall_(parameters.fall),
        least_(parameters.least),
        presliding_(parameters.presliding) {}

  /// See IntegralRegulator, also of the functions below.
  void restart(Scalar target) {
    RegulatorT::restart(target);
    begins_ = true;
  }

  bool target_changes(Scalar change) {
    const bool holds = RegulatorT::target_changes(change);
    begins_ = holds || begins_;
    return holds;
  }

  Scalar propose(Scalar target, Scalar measured) {
    if (rise_ == Scalar{}) {
      return followed_ = RegulatorT::propose(target, measured);
    }
    if (begins_) {
      model_ = numeric::clamp(measured, close(), whole_ratio<Scalar>);
      begins_ = false;
    }
    if (numeric::abs(target - model_) <= close()) {
      model_ = target;
      return followed_ = RegulatorT::propose(target, measured);
    }
    const Scalar before = model_;
    const Scalar command = move_to(target);
    followed_ = RegulatorT::propose(before, measured);
    return followed_ +
           numeric::clamp(command - before, -followed_, whole_ratio<Scalar> - followed_);
  }

  /// That of the last proposal without what is beyond it.
  Scalar implied(Scalar /*ratio*/) const { return followed_; }

 private:
  /// Closer to the target than this, the model is taken to be there.
  static constexpr Scalar close() { return numeric::from_real<Scalar>(1.0 / 8192.0); }

  /// Moves the model by a period. @return the command that moves the contact so
  Scalar move_to(Scalar target) {
    const Scalar before = model_;
    const Scalar wanted = numeric::half(numeric::half(target - before));
    // The product is of a negative number: it rounds down, so that the model never stands still.
    const Scalar rise = -numeric::rough_product(rise_, before - whole_ratio<Scalar>);
    if (rise <= wanted) {
      model_ = before + rise;
      return whole_ratio<Scalar>;
    }
    const Scalar least = numeric::min(least_, target);
    const Scalar fall = numeric::rough_product(fall_, least - before);
    if (wanted <= fall) {
      model_ = before + fall;
      return least;
    }
    model_ = before + wanted;
    return moving(before, wanted);
  }

  /// m/(1 − w tp/T), in sixteenths.
  Scalar moving(Scalar model, Scalar step) const {
    const Scalar part = numeric::from_real<Scalar>(1.0 / 16.0) -
                        numeric::limited_lift(numeric::rough_product(step, presliding_.mantissa),
                                              presliding_.exponent);
    if (part <= close()) {
      return whole_ratio<Scalar>;
    }
    const auto quotient = numeric::quotient(numeric::floating(model), numeric::floating(part));
    return numeric::min(whole_ratio<Scalar>,
                        numeric::limited_value(numeric::rescaled(quotient, -4)));
  }

  Scalar rise_;
  Scalar fall_;
  Scalar least_;
  numeric::Split<Scalar> presliding_;
  Scalar model_ = whole_ratio<Scalar>;
  Scalar followed_ = whole_ratio<Scalar>;  ///< the regulator's own command
  bool begins_ = true;                     ///< the next measured ratio is where the model begins
};

}  // namespace sonoglide::control
