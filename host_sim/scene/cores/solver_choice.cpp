#include "host_sim/scene/cores/solver_choice.hpp"

#include <cmath>
#include <type_traits>
#include <variant>

#include "firmware/numeric/turn.hpp"
#include "host_sim/scene/cores/solver_cores.hpp"
#include "host_sim/scene/law_cores.hpp"
#include "host_sim/scene/solver_methods.hpp"

namespace sonoglide::scene {
namespace {

constexpr SolverMethod event_gauss = method_of<solvers::EventGauss>;

/// One table of the motion serves the run.
bool keeps_its_table(const Scene& scene) {
  return scene.drive && !scene.load && scene.drive->waveform == Waveform::cosine &&
         scene.drive->codes_per_period == 1 && !scene.carrier_changes() &&
         scene.profile_key() == nullptr && solves(event_gauss, scene.friction.law);
}

/// Of a spring too soft and a damper too weak to take much of the drive.
double vibration_m_per_s(const Scene& scene, double inertia_N_per_m, double omega_rad_per_s) {
  return scene.drive_force_N() * omega_rad_per_s /
         (inertia_N_per_m - scene.plant.stiffness_N_per_m);
}

bool suits_event_gauss(const Scene& scene) {
  const Plant& plant = scene.plant;
  const double omega = scene.drive->rate_rad_per_s();
  const double inertia_N_per_m = plant.mass_kg * omega * omega;
  if (plant.stiffness_N_per_m > 0.25 * inertia_N_per_m ||
      plant.damping_N_s_per_m > 0.1 * plant.mass_kg * omega) {
    return false;
  }
  const double sliding = scene.sliding.fastest_m_per_s();
  const double vibration = scene.controller ? std::sqrt(2.0) * sliding
                                            : vibration_m_per_s(scene, inertia_N_per_m, omega);
  const double tolerance = scene.solver.tolerance;
  const double limit_N = scene.friction.limit_N();
  const double dahl_number =
      scene.friction.contact_stiffness_N_per_m * vibration / (omega * limit_N);
  const double force_share = limit_N / (plant.mass_kg * omega * vibration);
  return tolerance >= 1e-10 && tolerance <= 1e-5 && 0.75 * vibration >= sliding &&
         dahl_number >= 0.1 && dahl_number <= 1.0 && force_share <= 0.2 * std::cbrt(tolerance) &&
         dahl_number * force_share <=
             std::pow(3.0 * tolerance, 0.25) / (numeric::two_pi * numeric::two_pi);
}

}  // namespace

bool solves(SolverMethod method, const FrictionLaw& law) {
  return with_solver(method, [&](auto solver) {
    return std::visit(
        [](const auto& any) {
          using Law = typename std::decay_t<decltype(any)>::template Core<double>;
          return takes_law<decltype(solver), Law>;
        },
        law);
  });
}

SolverMethod fastest_method(const Scene& scene) {
  const bool gauss = !scene.solver.order && keeps_its_table(scene) && suits_event_gauss(scene);
  return gauss ? event_gauss : method_of<solvers::EventTaylor>;
}

}  // namespace sonoglide::scene
