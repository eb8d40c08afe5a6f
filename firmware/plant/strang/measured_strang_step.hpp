/// A step of the splitting method with two measures of its error.
#pragma once

#include "firmware/numeric/scalar.hpp"
#include "firmware/plant/account.hpp"
#include "firmware/plant/state.hpp"
#include "firmware/plant/strang/strang_step.hpp"

namespace sonoglide::plant {

/// The step as an account sees it, its integrals computed once, and two defects of it:
///   velocity  what the kicks miss of the impulse of friction along the flow, or the path that the
///             contact is led along misses of the flow
///   energy    what the balance of the step, as the account will have it, leaves over:
///             gain of the oscillator - drive work + damping work + sigma beta (friction work -
///             sliding work)
template <class Model>
class MeasuredStrangStep {
 public:
  using Scalar = typename Model::Scalar;

  MeasuredStrangStep(const Model& model, const StrangStep<Model>& step)
      : step_(step),
        friction_integral_(step.friction_integral()),
        friction_work_(step.friction_work()),
        sliding_work_(step.sliding_work()),
        motion_(step.motion_integrals()),
        gain_(step.gain()),
        contact_scale_(model.contact_work(Scalar(1))) {}

  Scalar begin() const { return step_.begin(); }
  Scalar length() const { return step_.length(); }
  State<Scalar> at(Scalar offset) const { return step_.at(offset); }
  Scalar friction_integral() const { return friction_integral_; }
  Scalar friction_work() const { return friction_work_; }
  Scalar sliding_work() const { return sliding_work_; }
  const MotionIntegrals<Scalar>& motion_integrals() const { return motion_; }

  Scalar velocity_defect() const {
    return numeric::max(numeric::abs(step_.missed_impulse(friction_integral_)),
                        step_.missed_path());
  }
  Scalar energy_defect() const {
    return numeric::abs(
        (gain_.kicks + contact_work()) +
        ((gain_.kinetic + gain_.elastic) - (motion_.drive_work - motion_.damping_work)));
  }
  /// The largest energy that drive, damper or contact passed on.
  Scalar passed_energy() const {
    return numeric::max(
        numeric::max(numeric::abs(motion_.drive_work), numeric::abs(motion_.damping_work)),
        numeric::abs(contact_work()));
  }
  /// What rounding is relative to in energy_defect().
  Scalar energy_terms() const {
    return numeric::abs(gain_.kicks) + numeric::abs(gain_.kinetic) + numeric::abs(gain_.elastic) +
           numeric::abs(motion_.drive_work) + numeric::abs(motion_.damping_work) +
           numeric::abs(contact_scale_) *
               (numeric::abs(friction_work_) + numeric::abs(sliding_work_));
  }

 private:
  Scalar contact_work() const { return contact_scale_ * (friction_work_ - sliding_work_); }

  const StrangStep<Model>& step_;
  Scalar friction_integral_;
  Scalar friction_work_;
  Scalar sliding_work_;
  MotionIntegrals<Scalar> motion_;
  typename StrangStep<Model>::Gain gain_;
  Scalar contact_scale_;  ///< sigma beta
};

}  // namespace sonoglide::plant
