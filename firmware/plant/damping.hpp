/// Viscous damping of the oscillator.
#pragma once

namespace sonoglide::plant {

template <class Scalar>
struct Undamped {
  Scalar damping_force(Scalar /*velocity*/) const { return Scalar(0); }
};

template <class Scalar>
struct Damped {
  Scalar damping = Scalar(0);  ///< d = c / (m omega) [-]

  Scalar damping_force(Scalar velocity) const { return damping * velocity; }
};

}  // namespace sonoglide::plant
