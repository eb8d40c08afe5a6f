#include "host_sim/loop/plant/changing_spring.hpp"

namespace sonoglide::loop {
namespace {

double elastic_J(double stiffness_N_per_m, double displacement_m) {
  return 0.5 * stiffness_N_per_m * displacement_m * displacement_m;
}

}  // namespace

void ChangingSpring::settle(const Course& course, const PlantState& begin, const PlantState& end,
                            EnergyBalance& energy) {
  const Line& stiffness_N_per_m = course.stiffness_N_per_m;
  const double duration_s = course.duration_s;
  const double first_N_per_m = stiffness_N_per_m.at(-0.5 * duration_s);
  const double last_N_per_m = stiffness_N_per_m.at(0.5 * duration_s);
  const double jump_J = elastic_J(first_N_per_m - reached_N_per_m_, begin.displacement_m);
  if (course.slopes()) {
    const auto stored_J = [this](double stiffness, const PlantState& state) {
      return 0.5 * mass_kg_ * state.velocity_m_per_s * state.velocity_m_per_s +
             elastic_J(stiffness, state.displacement_m);
    };
    energy.stored_begin_J = stored_J(first_N_per_m, begin);
    energy.stored_end_J = stored_J(last_N_per_m, end);
  }
  energy.stored_begin_J -= jump_J;
  energy.spring_work_J =
      jump_J + 0.5 * stiffness_N_per_m.slope_per_s * energy.displacement_square_m2_s;
  reached_N_per_m_ = last_N_per_m;
}

}  // namespace sonoglide::loop
