/// One plant with a Dahl contact, run open loop from an initial state, and what comes of it. All
/// dimensionless, as in plant::Model and plant::State.
#pragma once

#include <cstdint>

#include "firmware/plant/state.hpp"

namespace sonoglide::batch {

/// y'' = a cos(tau) - d y' - k y - beta phi,  phi' = kappa (V - |V| phi),  V = r + sigma y'.
struct DahlPlant {
  double drive_amplitude = 1.0;    ///< a
  double damping = 0.0;            ///< d >= 0
  double stiffness = 0.0;          ///< k >= 0
  double friction_force = 0.0;     ///< beta >= 0
  double contact_stiffness = 1.0;  ///< kappa in [1e-9, 1e9]
  double sliding_velocity = 0.0;   ///< r, any sign, constant
  double vibration_sign = 1.0;     ///< sigma: +1 dissipative, -1 as the paper prints it
  plant::State<double> initial;    ///< at tau = 0; |phi| <= 1
};

/// The whole run begins at tau = 0, its window at a later period; both end together.
struct RunLength {
  std::uint32_t periods = 100;             ///< whole carrier periods, > 0
  std::uint32_t window_start_periods = 0;  ///< < periods
};

/// Every status but `solved` asks for the scalar solver: the lanes gave that point up.
enum class RunStatus {
  solved,
  outside_range,       ///< a parameter that the lanes are not made for, or no number at all
  undecided_reversal,  ///< V = 0 and its derivative too: higher ones decide where it goes
  too_many_steps,      ///< more than 1024 steps for each period
  not_finite,          ///< the motion has left the range of the scalar
};

struct FrictionAverages {
  double friction_ratio = 0.0;  ///< mean of phi
  double friction_work = 0.0;   ///< integral of phi V over tau
};

struct DahlRun {
  RunStatus status = RunStatus::outside_range;
  FrictionAverages whole;
  FrictionAverages window;
  plant::State<double> final_state;
};

}  // namespace sonoglide::batch
