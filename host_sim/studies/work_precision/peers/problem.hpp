/// The motion that every contender computes.
#pragma once

namespace sonoglide::peers {

/// A Dahl contact on a driven oscillator, at a constant sliding velocity:
///   y'' = a cos tau - d y' - k y - beta phi,   phi' = kappa (V - |V| phi),   V = r + sigma y'.
/// All dimensionless, in the units of plant::Model. The run begins at tau = 0.
struct Problem {
  double stiffness;          ///< k
  double damping;            ///< d, >= 0
  double friction_force;     ///< beta, > 0
  double contact_stiffness;  ///< kappa, > 0
  double vibration_sign;     ///< sigma: +1 dissipative, -1 as the paper prints it
  double drive_amplitude;    ///< a, >= 0
  double sliding_velocity;   ///< r
  double displacement;       ///< y at the beginning
  double velocity;           ///< y' at the beginning
  double friction;           ///< phi at the beginning
  int periods;               ///< length of the run in carrier periods, > 0
};

inline constexpr double carrier_period = 6.28318530717958647693;  ///< 2 pi, in tau

}  // namespace sonoglide::peers
