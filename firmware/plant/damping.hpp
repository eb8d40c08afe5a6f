/// Viscous damping of the oscillator.
#pragma once

namespace sonoglide::plant {

/// No damping, and no member for it.
template <class Scalar>
struct Undamped {
  Scalar damping_force(Scalar /*velocity*/) const { return Scalar(0); }
};

/// Damping force d v on the oscillator.
template <class Scalar>
struct Damped {
  Scalar damping = Scalar(0);  ///< d = c / (m omega) [-]

  Scalar damping_force(Scalar velocity) const { return damping * velocity; }
};

}  // namespace sonoglide::plant
