/// Feedforward for a contact of any law.
#pragma once

#include <cstdint>

#include "firmware/control/friction/friction_level.hpp"
#include "firmware/control/interface/part_name.hpp"
#include "firmware/friction/inverse_table.hpp"
#include "firmware/numeric/floating.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// Inverse map from a table that is made with the design of the controller, for its law and its contact.
/// The rows of the table are those of the sliding speed, or of the sliding speed over the friction force
/// that is learnt.
template <class ScalarT>
class TabulatedFeedforward {
 public:
  static constexpr PartName part_name{"friction/tabulated_feedforward", "TabulatedFeedforward"};
  using Scalar = ScalarT;

  struct Parameters {
    /// λ, the reduced travel of the table's rows at a ratio of 1, at a speed of 1; over force: times the
    /// friction force.
    numeric::Split<Scalar> travel;
    numeric::Split<Scalar> reach;  ///< see friction::tabulated_vibration_velocity
    bool over_force;               ///< λ is over the friction force
    friction::InverseForm form;
    friction::InverseTable table;

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("travel", self.travel);
      visit("reach", self.reach);
      visit("over_force", self.over_force);
      visit("form", self.form);
      visit("table", self.table);
    }
  };

  /// @param parameters  outlive this: the table stays where it is
  explicit TabulatedFeedforward(const Parameters& parameters)
      : half_travel_at_force_(numeric::floating(
            numeric::Split<Scalar>{parameters.travel.mantissa, parameters.travel.exponent - 1})),
        half_travel_(half_travel_at_force_),
        reach_(numeric::floating(parameters.reach)),
        over_force_(parameters.over_force),
        form_(parameters.form),
        table_(&parameters.table) {}

  /// See Controller::settle_at.
  void settle_at(const Parameters& parameters) { table_ = &parameters.table; }

  void set_friction(const FrictionLevel<Scalar>& friction) {
    if (over_force_) {
      half_travel_ = numeric::quotient(half_travel_at_force_, friction.level());
    }
  }

  /// Drive amplitude in [0, 1] at which the friction ratio is reached; where none does, that of the
  /// nearest ratio or the largest value.
  /// @param half_ratio  friction ratio on base 2, in [0, 1/2].
  /// @param speed       |Vt|, base the peak vibration velocity at full drive; > 0.
  /// Error: the contact then has the ratio within 0.008, from a ratio of 0.1 on, in float64, float32 and
  /// Q31; at a level or a speed other than that of the design 0.01. In Q15 twice that, for speeds from
  /// 0.05, and within 0.1 of the lowest ratio that the contact has (InverseDesignTest).
  Scalar amplitude(Scalar half_ratio, Scalar speed) const {
    return friction::tabulated_vibration_velocity(half_ratio, speed, half_travel_, reach_, form_,
                                                  *table_);
  }

 private:
  numeric::Floating<Scalar> half_travel_at_force_;
  numeric::Floating<Scalar> half_travel_;  ///< λ/2 at a speed of 1
  numeric::Floating<Scalar> reach_;
  bool over_force_;
  friction::InverseForm form_;
  const friction::InverseTable* table_;
};

}  // namespace sonoglide::control
