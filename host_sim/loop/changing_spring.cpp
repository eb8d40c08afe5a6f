#include "host_sim/loop/changing_spring.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/numeric/turn.hpp"

namespace sonoglide::loop {
namespace {

double elastic_J(double stiffness_N_per_m, double displacement_m) {
  return 0.5 * stiffness_N_per_m * displacement_m * displacement_m;
}

}  // namespace

ChangingSpring::ChangingSpring(const scene::Scene& scene)
    : profile_(scene.plant.stiffness_profile),
      constant_N_per_m_(scene.plant.stiffness_N_per_m),
      mass_kg_(scene.plant.mass_kg),
      contact_stiffness_N_per_m_(scene.friction.contact_stiffness_N_per_m),
      reached_N_per_m_(scene.plant.stiffness_N_per_m) {}

ChangingSpring::Line ChangingSpring::over(const Stretch& stretch) const {
  if (profile_.empty()) {
    return {constant_N_per_m_, 0.0};
  }
  // Inside: at the ends there may be a jump.
  const double quarter_s = 0.25 * stretch.duration_s;
  const double early = scene::value_at(profile_, stretch.begin_s + quarter_s);
  const double late = scene::value_at(profile_, stretch.begin_s + 3.0 * quarter_s);
  return {0.5 * (early + late), (late - early) / (2.0 * quarter_s)};
}

double ChangingSpring::pieces(const Stretch& stretch, const Line& line) const {
  if (line.slope_N_per_m_s == 0.0) {
    return 0.0;
  }
  const double most_N_per_m =
      std::max(line.at(-0.5 * stretch.duration_s), line.at(0.5 * stretch.duration_s));
  const double rate_rad_per_s =
      std::max(stretch.drive_rate_rad_per_s,
               std::sqrt(std::max(most_N_per_m, contact_stiffness_N_per_m_) / mass_kg_));
  const double period_s = numeric::two_pi / rate_rad_per_s;
  const double change = std::abs(line.slope_N_per_m_s) * period_s / most_N_per_m;
  const double pairs_a_period = numeric::two_pi * std::pow(change / (2880.0 * largest_error), 0.25);
  return 2.0 * std::max(1.0, std::ceil(pairs_a_period * stretch.duration_s / period_s));
}

double ChangingSpring::held_N_per_m(const Stretch& stretch, const Line& line, double index,
                                    double count) {
  const double pair_s = 2.0 * stretch.duration_s / count;
  const double pair = std::floor(0.5 * index);
  const double middle_s = (pair + 0.5) * pair_s - 0.5 * stretch.duration_s;
  const double side = index == 2.0 * pair ? -1.0 : 1.0;
  return line.at(middle_s + side * pair_s / 3.0);
}

void ChangingSpring::settle(const Stretch& stretch, const Line& line, double count, double begin_m,
                            double end_m, EnergyBalance& energy) {
  const double first_N_per_m = line.at(-0.5 * stretch.duration_s);
  const double last_N_per_m = line.at(0.5 * stretch.duration_s);
  const double jump_J = elastic_J(first_N_per_m - reached_N_per_m_, begin_m);
  const bool slopes = line.slope_N_per_m_s != 0.0;
  const auto held = [&](double index) {
    return slopes ? held_N_per_m(stretch, line, index, count) : line.middle_N_per_m;
  };
  energy.stored_begin_J += elastic_J(first_N_per_m - held(0.0), begin_m) - jump_J;
  energy.stored_end_J += elastic_J(last_N_per_m - held(count - 1.0), end_m);
  energy.spring_work_J = jump_J + 0.5 * line.slope_N_per_m_s * energy.displacement_square_m2_s;
  reached_N_per_m_ = last_N_per_m;
}

}  // namespace sonoglide::loop
