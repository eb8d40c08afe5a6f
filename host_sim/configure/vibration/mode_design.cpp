#include "host_sim/configure/vibration/mode_design.hpp"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/turn.hpp"
#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/scene/bound.hpp"

namespace sonoglide::configure {
namespace {

/// The modulus of a 2 x 2 matrix: its largest singular value.
double norm_of(const Eigen::Matrix2d& matrix) {
  return Eigen::JacobiSVD<Eigen::Matrix2d>(matrix).singularValues()(0);
}

}  // namespace

double stiffness_range(double stiffness) {
  constexpr double widest = 0.06;
  constexpr double towards_carrier = 2.0 / 3.0;
  constexpr double radians = 0.72;
  const double carrier = numeric::two_pi * numeric::two_pi;
  return std::min({widest, towards_carrier * std::abs(1.0 - carrier / stiffness),
                   2.0 * radians / numeric::sqrt(stiffness)});
}

Eigen::RowVector3d feedback_of(const ModeModel& model, const Eigen::Matrix3d& error) {
  constexpr double quickest = 1.15;
  constexpr double slower = 0.6;
  constexpr double quick_enough = 1.01;
  constexpr double visible = 0.05;          // of full drive's velocity, after a full kick
  constexpr double largest_feedback = 2.0;  // amplitude for a full kick's mode
  const double input_gain = model.input_gain.norm();
  double stability =
      norm_of(model.output) * input_gain < visible * model.forced.norm() ? 1.0 : quickest;
  while (true) {
    Eigen::RowVector3d gains = feedback_gains(model, error, stability);
    if (stability == 1.0 || gains.head<2>().norm() * input_gain < largest_feedback) {
      return gains;
    }
    stability = 1.0 + slower * (stability - 1.0);
    stability = stability < quick_enough ? 1.0 : stability;
  }
}

void require_mode(const NominalPlant& plant) {
  if (!(plant.stiffness_N_per_m > 0.0)) {
    throw ConfigurationError(
        "plant.stiffness_N_per_m",
        "is 0, and a mass without a spring has no natural mode; allowed: above "
        "0 with controller.vibration = \"damped\"");
  }
  constexpr double most = 0.9;  // of the critical damping
  const double critical =
      2.0 * numeric::sqrt(plant.stiffness_N_per_m) * numeric::sqrt(plant.mass_kg);
  if (!(plant.damping_N_s_per_m < most * critical)) {
    throw ConfigurationError(
        "plant.damping_N_s_per_m",
        fmt::format("leaves no natural mode to damp; allowed: below {} N s/m with "
                    "controller.vibration = \"damped\"",
                    scene::at_most(most * critical, 3)));
  }
}

Resonator nominal_resonator(const scene::Scene& scene, const NominalPlant& plant,
                            double velocity_m_per_s) {
  const double period_s = 1.0 / scene.drive->frequency_Hz;
  return {plant.stiffness_N_per_m / plant.mass_kg * period_s * period_s,
          plant.damping_N_s_per_m / plant.mass_kg * period_s,
          scene.max_drive_force_N() * plant.force_factor * period_s /
              (plant.mass_kg * velocity_m_per_s)};
}

}  // namespace sonoglide::configure
