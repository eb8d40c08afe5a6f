#include "host_sim/loop/plant/failure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "firmware/numeric/turn.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/loop/plant/carrier_grid.hpp"
#include "host_sim/scene/solver_facts.hpp"
#include "host_sim/scene/solver_methods.hpp"

namespace sonoglide::loop {
namespace {

std::string_view period_word(const scene::Scene& scene) {
  return scene.drive ? "carrier period" : "thousandth of the run";
}

bool rubs(const scene::Scene& scene) {
  return scene.friction.largest_limit_N() > 0.0;
}

/// What the plant does in one carrier period, in radians.
struct Rates {
  double mode = 0.0;    ///< of the natural mode
  double damper = 0.0;  ///< of the decay, in a plant without a spring
  double stuck = 0.0;   ///< of the mode while the contact sticks: a spring beside the plant's own
  double slide = 0.0;   ///< of the contact's decay to its limit, as fast as the body slides
  double load = 0.0;    ///< of the decay of a load's velocity by its damper
};

Rates rates_in(const scene::Scene& scene, double time_s) {
  const double stiffness_N_per_m = scene.plant.stiffest_N_per_m();
  const double mass_kg = scene.plant.mass_kg;
  Rates rates;
  rates.mode = time_s * std::sqrt(stiffness_N_per_m / mass_kg);
  rates.damper = time_s * scene.plant.damping_N_s_per_m / mass_kg;
  if (scene.load) {
    rates.load = time_s * scene.load->damping_N_s_per_m / scene.load->mass_kg;
  }
  if (rubs(scene) && scene::is_elastic(scene.friction.law)) {
    rates.stuck =
        time_s *
        std::sqrt((stiffness_N_per_m + scene.friction.contact_stiffness_N_per_m) / mass_kg);
    rates.slide = time_s * scene.friction.contact_stiffness_N_per_m *
                  scene.sliding.fastest_m_per_s() / scene.friction.largest_limit_N();
  }
  return rates;
}

std::string of_mode(const scene::Scene& scene, const Rates& rates, double time_s) {
  const double turns = rates.mode / numeric::two_pi;
  const std::string mode =
      fmt::format("the natural mode, sqrt(Ks/m)/2π = {:.4g} Hz, turns {:.4g} times in one {}",
                  turns / time_s, turns, period_word(scene));
  return mode + (rubs(scene)
                     ? " and the friction changes with it, so that each turn has to be resolved"
                     : ": its phase is lost in the rounding of the numbers");
}

std::string of_damper(const scene::Scene& scene, const Rates& rates, double time_s) {
  return fmt::format("the damper stops the mass within m/c = {:.4g} s, 1/{:.4g} of one {}",
                     time_s / rates.damper, rates.damper, period_word(scene));
}

std::string of_load(const scene::Scene& scene, const Rates& rates, double time_s) {
  return fmt::format("the damper of the load stops it within M/c = {:.4g} s, 1/{:.4g} of one {}",
                     time_s / rates.load, rates.load, period_word(scene));
}

std::string of_stuck_contact(const scene::Scene& scene, const Rates& rates, double time_s) {
  const double turns = rates.stuck / numeric::two_pi;
  return fmt::format(
      "a stuck contact rings at sqrt((Kt + Ks)/m)/2π = {:.4g} Hz, {:.4g} times in one {}, which "
      "has "
      "to be resolved",
      turns / time_s, turns, period_word(scene));
}

std::string of_slip(const scene::Friction& friction) {
  return fmt::format(
      "the contact slides more than Fc/(2 Kt) = {:.4g} m in one step, while its friction grows",
      0.5 * friction.largest_limit_N() / friction.contact_stiffness_N_per_m);
}

std::string of_sliding(const Rates& rates, double time_s) {
  return fmt::format("the contact slides to its limit within Fc/(Kt Vt) = {:.4g} s",
                     time_s / rates.slide);
}

/// Nothing turns so fast, in radians of a period, that it is the cause of a step limit.
constexpr double slow = 1e-3 * plant::max_steps_per_advance;

/// The fastest of what the steps have to follow. The mode and the damper alone need so many steps
/// where they are this fast, whatever the contact does.
std::string fastest(const scene::Scene& scene, double enough_alone) {
  const double time_s = CarrierGrid(scene).period_s();
  const Rates rates = rates_in(scene, time_s);
  const double free = std::max(rates.mode, rates.damper);
  if (rates.stuck > 2.0 * free && free < enough_alone) {
    return of_stuck_contact(scene, rates, time_s);
  }
  return rates.damper > rates.mode ? of_damper(scene, rates, time_s)
                                   : of_mode(scene, rates, time_s);
}

/// The limits are those of the classical Runge-Kutta method, and of rk4_event in a contact.
std::string step_too_long(const scene::Scene& scene) {
  const Rates in_step = rates_in(scene, scene.solver.step_s);
  const double contact = in_step.stuck * in_step.stuck - in_step.mode * in_step.mode;
  const double period_s = CarrierGrid(scene).period_s();
  if (in_step.mode > std::sqrt(8.0) || in_step.damper > 2.785) {
    return fastest(scene, 0.0);
  }
  return contact > 1.0 ? of_stuck_contact(scene, rates_in(scene, period_s), period_s)
                       : of_slip(scene.friction);
}

constexpr const char* a_remedy = "; a shorter solver.step_s would do, or event_taylor";

std::string too_many_steps(const scene::Scene& scene, const plant::Cost& cost) {
  const std::string need =
      fmt::format("one {} needs more than {} steps ({} were taken since the run began); ",
                  period_word(scene), plant::max_steps_per_advance, cost.steps);
  if (!scene::is_adaptive(scene.solver.method)) {
    return need + fmt::format("solver.step_s = {:.6g} cuts it into {:.4g}", scene.solver.step_s,
                              CarrierGrid(scene).period_s() / scene.solver.step_s);
  }
  const Rates rates = rates_in(scene, CarrierGrid(scene).period_s());
  const double plants_own = std::max({rates.mode, rates.damper, rates.stuck});
  if (rates.load >= slow && rates.load > plants_own) {
    return need + of_load(scene, rates, CarrierGrid(scene).period_s());
  }
  if (plants_own < slow) {
    if (rates.slide >= slow) {
      return need + of_sliding(rates, CarrierGrid(scene).period_s());
    }
    const bool second_order = scene.solver.method == scene::method_of<scene::solvers::Strang>;
    if (!second_order && scene::vibration_of(scene.friction.law) == friction::Vibration::across) {
      return need +
             "the contact comes to rest, with sliding and vibration at 0 together, which "
             "friction.law = \"transverse_coulomb\" does not model";
    }
    return need + fmt::format(
                      "nothing in the plant is so fast: solver.tolerance = {:.6g} asks for "
                      "them{}",
                      scene.solver.tolerance,
                      second_order
                          ? " of strang, which is of second order; event_taylor takes fewer"
                          : "");
  }
  return need + fastest(scene, 10.0 * slow);
}

}  // namespace

std::string failure_cause(const scene::Scene& scene, plant::Error error, const plant::Cost& cost) {
  switch (error) {
    case plant::Error::friction_bound_broken:
      return fmt::format("{}, the step is too long for the contact stiffness{}",
                         scene::broken_bound(scene.friction.law), a_remedy);
    case plant::Error::step_too_long:
      return "the step is too long: " + step_too_long(scene) + a_remedy;
    case plant::Error::too_many_steps:
      return too_many_steps(scene, cost);
    case plant::Error::not_finite:
    case plant::Error::none:
      break;
  }
  return "the state is no longer finite";
}

std::string failure_reason(const scene::Scene& scene, plant::Error error, double time_s,
                           const PlantState& state, const plant::Cost& cost) {
  return fmt::format(
      "solver: at {:.6g} s, displacement {:.6g} m, velocity {:.6g} m/s, friction force {:.6g} N: "
      "{}",
      time_s, state.displacement_m, state.velocity_m_per_s, state.friction_force_N,
      failure_cause(scene, error, cost));
}

}  // namespace sonoglide::loop
