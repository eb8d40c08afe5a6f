#include <algorithm>
#include <cmath>
#include <cstddef>

#include "firmware/numeric/turn.hpp"
#include "host_sim/loop/plant/changing_plant.hpp"

// What becomes of the results of pieces: joined, extrapolated to no length, and compared.

namespace sonoglide::loop {

/// What comes after `first` is `second`.
ChangingPlant::Piece ChangingPlant::joined(const Piece& first, const Piece& second) {
  Piece both = second;
  both.offset_s = first.offset_s;
  both.length_s += first.length_s;
  both.energy = first.energy;
  both.energy.append(second.energy);
  both.events += first.events;
  return both;
}

/// fine + part (fine - coarse)
void ChangingPlant::extrapolate(const Piece& coarse, double part, Piece& fine) {
  const auto move = [part](double from, double& to) { to += part * (to - from); };
  move(coarse.end.state.displacement_m, fine.end.state.displacement_m);
  move(coarse.end.state.velocity_m_per_s, fine.end.state.velocity_m_per_s);
  for (std::size_t i = 0; i < coarse.end.forces_N.size(); ++i) {
    move(coarse.end.forces_N[i], fine.end.forces_N[i]);
  }
  const double duration_s = fine.energy.duration_s;
  fine.energy.add(fine.energy, part);
  fine.energy.add(coarse.energy, -part);
  fine.energy.duration_s = duration_s;
}

/// Each number relative to the size that the motion, the friction or a period's impulse has.
bool ChangingPlant::agree(const Piece& coarse, const Piece& fine) const {
  constexpr double rounding = 1e-12;
  const double allowed = std::max(rounding, share_of_tolerance * solver_.tolerance);
  const auto near = [allowed](double one, double other, double size) {
    return std::abs(one - other) <= allowed * size + 4e-16 * std::abs(one);
  };
  const PlantState& one = coarse.end.state;
  const PlantState& other = fine.end.state;
  const double omega = scales_.angular_frequency_rad_per_s;
  const double velocity_m_per_s =
      std::max(scales_.velocity_m_per_s(), std::abs(one.velocity_m_per_s));
  if (!near(one.velocity_m_per_s, other.velocity_m_per_s, velocity_m_per_s) ||
      !near(one.displacement_m, other.displacement_m, velocity_m_per_s / omega) ||
      !near(coarse.energy.friction_impulse_N_s, fine.energy.friction_impulse_N_s,
            largest_limit_N_ * numeric::two_pi / omega)) {
    return false;
  }
  return std::equal(coarse.end.forces_N.begin(), coarse.end.forces_N.end(),
                    fine.end.forces_N.begin(), fine.end.forces_N.end(),
                    [&](double a, double b) { return near(a, b, largest_limit_N_); });
}

}  // namespace sonoglide::loop
