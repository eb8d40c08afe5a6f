#include "host_sim/loop/failure.hpp"

#include <fmt/format.h>

#include <cmath>

#include "firmware/numeric/turn.hpp"
#include "host_sim/configure/plant_scales.hpp"

namespace sonoglide::loop {
namespace {

/// A contact that sticks is a spring beside the plant's own.
double stuck_frequency_Hz(const scene::Scene& scene) {
  const double stiffness = scene.plant.stiffness_N_per_m + scene.friction.contact_stiffness_N_per_m;
  return std::sqrt(stiffness / scene.plant.mass_kg) / numeric::two_pi;
}

/// What the steps were spent on, where that may be the contact; else nothing.
std::string ringing(const scene::Scene& scene) {
  if (!scene::is_elastic(scene.friction.law) ||
      configure::largest_friction_limit_N(scene.friction) <= 0.0) {
    return "";
  }
  const std::string drive =
      scene.drive ? fmt::format(" under a drive of {:.4g} Hz", scene.drive->frequency_Hz) : "";
  return fmt::format(
      "; a stuck contact rings at sqrt((Kt + Ks)/m)/2π = {:.4g} Hz{}, which has to be resolved",
      stuck_frequency_Hz(scene), drive);
}

std::string reason(const scene::Scene& scene, plant::Error error, const plant::Cost& cost) {
  switch (error) {
    case plant::Error::friction_bound_broken:
      return fmt::format("{}, the step is too long for the contact stiffness",
                         scene::broken_bound(scene.friction.law));
    case plant::Error::step_too_long:
      return "the step is too long for the contact or for the oscillator" + ringing(scene);
    case plant::Error::too_many_steps:
      return fmt::format(
          "more than {} steps in one {}, {} since the run began{}", plant::max_steps_per_advance,
          scene.drive ? "carrier period" : "thousandth of the run", cost.steps, ringing(scene));
    case plant::Error::not_finite:
    case plant::Error::none:
      break;
  }
  return "the state is no longer finite";
}

}  // namespace

std::string failure_reason(const scene::Scene& scene, plant::Error error, double time_s,
                           const PlantState& state, const plant::Cost& cost) {
  return fmt::format(
      "solver: at {:.6g} s, displacement {:.6g} m, velocity {:.6g} m/s, friction force {:.6g} N: "
      "{}",
      time_s, state.displacement_m, state.velocity_m_per_s, state.friction_force_N,
      reason(scene, error, cost));
}

}  // namespace sonoglide::loop
