/// The scenes of the cost ladder, and what a run over one of them leaves behind.
#pragma once

#include <cstdint>

#include "tests/common/constants/pi.hpp"

namespace sonoglide::cost {

using tests::two_pi;
inline constexpr int periods = 100;
inline constexpr int samples_per_period = 16;
inline constexpr int samples_per_run = periods * samples_per_period;
inline constexpr double sample_spacing = two_pi / samples_per_period;
/// What a scene gets that names neither: see the order that the host picks for this tolerance.
inline constexpr double tolerance = 1e-10;
/// The step of the paper.
inline constexpr double fixed_step = two_pi / 1000.0;

/// Dimensionless, as plant::Model; what a rung does not name is not read.
struct Scene {
  double stiffness;
  double damping;
  double friction_force;
  double contact_stiffness;
  double drive_amplitude;
  double sliding_velocity;
};

/// Table 1 of the paper at 384 N and velocity ratio 0.5.
inline constexpr Scene table_1 = {0.0467907, 0.01, 5.109e-5, 0.385592, 1.0, 0.52454};
/// Slow enough for the free oscillation to reverse the sliding.
inline constexpr Scene undriven = {0.0467907, 0.01, 5.109e-5, 0.385592, 0.0, 0.1};

/// Table 1 at a tenth of the peak velocity at full drive, the amplitude being the controller's.
inline constexpr Scene controlled = {0.0467907, 0.01, 5.109e-5, 0.385592, 0.0, 0.52454};

inline constexpr double initial_displacement = 1.0;

/// What the controller is told, per unit: Table 1, the sensor's full scale being 2 Fc.
struct ControlNumbers {
  double target_friction_ratio = 0.6;
  double friction_force = 0.5;
  double contact_force = 1.0108;
  double speed = 0.1;
  double speed_floor = 0.026;
  double lead_periods = 1.5;
  double gain = 0.148;
  std::uint16_t hold_periods = 5;
  std::uint16_t rest_periods = 7;
  std::uint16_t stuck_periods = 11;
  std::uint16_t implausible_periods = 21;
  std::uint32_t standstill_periods = 1200;
  double standstill_fall = 1.0 / 128.0;
  double settling_band = 0.005;
  std::uint16_t patience_periods = 60;
  double agreement = 0.8;
  double outer_tap = 0.6323;
  double middle_tap = -0.2646;
  double full_drive_amplitude = 5.0;  ///< of the plant, in its own units
};
inline constexpr ControlNumbers control_numbers = {};

/// Everything that a run computes, in the order of plant::State and plant::EnergyAccount; zero
/// where a rung does not compute it. Two loops that agree in all of it have done the same work.
struct Result {
  double displacement = initial_displacement;
  double velocity = 0.0;
  double friction = 0.0;
  double friction_integral = 0.0;
  double friction_work = 0.0;
  double sliding_work = 0.0;
  double drive_work = 0.0;
  double damping_work = 0.0;
  double velocity_square = 0.0;
  double displacement_square = 0.0;
  double drive_amplitude = 0.0;  ///< the last command of a controller
  std::uint64_t steps = 0;       ///< 0: the run failed
};

}  // namespace sonoglide::cost
