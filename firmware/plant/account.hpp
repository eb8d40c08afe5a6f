/// Integrals taken along a motion. A solver adds each accepted step to the account it is given.
#pragma once

#include <initializer_list>

#include "firmware/numeric/scalar.hpp"
#include "firmware/plant/state.hpp"

namespace sonoglide::plant {

/// Sums nothing.
struct NoAccount {
  template <class Step>
  void add(const Step& /*step*/) {}
};

/// For the friction ratio: mean phi = friction_integral / elapsed tau.
template <class Scalar>
struct MeanFriction {
  Scalar friction_integral = Scalar(0);  ///< integral of phi

  template <class Step>
  void add(const Step& step) {
    friction_integral += step.friction_integral();
  }
};

/// Integrals of the motion alone over a step or more.
template <class Scalar>
struct MotionIntegrals {
  Scalar drive_work = Scalar(0);           ///< of a cos(tau) v
  Scalar velocity_square = Scalar(0);      ///< of v^2
  Scalar displacement_square = Scalar(0);  ///< of y^2
  Scalar damping_work = Scalar(0);         ///< of d v^2

  /// Adds one node of a quadrature; the damping work follows from the rest.
  void add(Scalar weight, Scalar drive, Scalar displacement, Scalar velocity) {
    drive_work += weight * (drive * velocity);
    velocity_square += weight * (velocity * velocity);
    displacement_square += weight * (displacement * displacement);
  }
};

/// Integrals of the energy balance over tau.
template <class Scalar>
struct EnergyAccount {
  Scalar friction_integral = Scalar(0);    ///< integral of phi
  Scalar friction_work = Scalar(0);        ///< of phi V: into the contact, times beta
  Scalar sliding_work = Scalar(0);         ///< of phi r: from whatever pulls, times beta
  Scalar drive_work = Scalar(0);           ///< of a cos(tau) v: from the drive
  Scalar damping_work = Scalar(0);         ///< of d v^2: into the damper
  Scalar velocity_square = Scalar(0);      ///< of v^2
  Scalar displacement_square = Scalar(0);  ///< of y^2

  template <class Step>
  void add(const Step& step) {
    // Both before anything is written: they have the integral in common.
    const Scalar integral = step.friction_integral();
    const Scalar sliding = step.sliding_work();
    friction_integral += integral;
    friction_work += step.friction_work();
    sliding_work += sliding;
    const MotionIntegrals<Scalar> motion = step.motion_integrals();
    drive_work += motion.drive_work;
    damping_work += motion.damping_work;
    velocity_square += motion.velocity_square;
    displacement_square += motion.displacement_square;
  }

  /// Residual of the identity
  ///   stored(after) - stored(before) = drive_work - damping_work
  ///                                    - sigma beta (friction_work - sliding_work),
  /// relative to the largest of its terms; 0 if all of them are 0. The works are net: over whole
  /// periods of a light contact they may be far smaller than the energy that was exchanged.
  template <class Model>
  Scalar balance_residual(const Model& model, const State<Scalar>& before,
                          const State<Scalar>& after) const {
    const Scalar largest = largest_term(model, before, after);
    const Scalar gain = model.stored_energy(after) - model.stored_energy(before);
    const Scalar loss =
        model.contact_work(friction_work) - model.contact_work(sliding_work) + damping_work;
    return largest > Scalar(0) ? (gain - drive_work + loss) / largest : Scalar(0);
  }

  /// The largest term of that identity, in magnitude.
  template <class Model>
  Scalar largest_term(const Model& model, const State<Scalar>& before,
                      const State<Scalar>& after) const {
    Scalar largest = Scalar(0);
    for (const Scalar term :
         {model.stored_energy(before), model.stored_energy(after), drive_work, damping_work,
          model.contact_work(friction_work), model.contact_work(sliding_work)}) {
      largest = numeric::max(largest, numeric::abs(term));
    }
    return largest;
  }
};

/// Integrals of the motion of a load over a step or more, in its own units: M L^2 omega^2.
template <class Scalar>
struct LoadIntegrals {
  Scalar force_work = Scalar(0);       ///< of fa r: from the applied force
  Scalar pull_work = Scalar(0);        ///< of -kl z vp: from the pulled end of the spring
  Scalar velocity_square = Scalar(0);  ///< of r^2

  void add(const LoadIntegrals& other, Scalar weight = Scalar(1)) {
    force_work += weight * other.force_work;
    pull_work += weight * other.pull_work;
    velocity_square += weight * other.velocity_square;
  }
};

/// The same balance with the energy of a load in it (LoadedModel).
template <class Scalar>
struct LoadedEnergyAccount : EnergyAccount<Scalar> {
  LoadIntegrals<Scalar> load;

  template <class Step>
  void add(const Step& step) {
    EnergyAccount<Scalar>::add(step);
    load.add(step.load_integrals());
  }

  /// Residual of the identity of the load,
  ///   stored(after) - stored(before) = (force_work + pull_work - damping_work) / eps
  ///                                    - beta sliding_work,
  /// relative to the largest of its terms; 0 if all of them are 0. The oscillator has its own.
  template <class Model>
  Scalar load_residual(const Model& model, const LoadedState<Scalar>& before,
                       const LoadedState<Scalar>& after) const {
    const Scalar into_damper = model.load_damping * load.velocity_square;
    const Scalar stored[] = {model.load_energy(before), model.load_energy(after)};
    const Scalar friction = model.contact_force(this->sliding_work);
    Scalar largest = numeric::max(numeric::max(stored[0], stored[1]), numeric::abs(friction));
    for (const Scalar work : {load.force_work, load.pull_work, into_damper}) {
      largest = numeric::max(largest, numeric::abs(work) / model.mass_ratio);
    }
    const Scalar given = (load.force_work + load.pull_work - into_damper) / model.mass_ratio;
    return largest > Scalar(0) ? (stored[1] - stored[0] - given + friction) / largest : Scalar(0);
  }
};

}  // namespace sonoglide::plant
