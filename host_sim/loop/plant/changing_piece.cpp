#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "firmware/numeric/turn.hpp"
#include "host_sim/loop/plant/changing_plant.hpp"

// What becomes of the results of pieces: joined, extrapolated to no length, and compared.

namespace sonoglide::loop {

/// What comes after `first`, which may be empty, is `second`.
ChangingPlant::Piece ChangingPlant::joined(const Piece& first, const Piece& second) {
  if (first.length_s == 0.0) {
    return second;
  }
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

/// Aitken and Neville's tableau in the square of the length of a part.
/// @param next  of `parts` parts
/// @param row   that of one part fewer: row[i] from i + 1 numbers of parts; then that of these
/// @return its last
const ChangingPlant::Piece& ChangingPlant::extrapolate(Piece next, int parts, Tableau& row) {
  const auto last = static_cast<std::size_t>(parts) - 1;
  for (std::size_t i = 0; i < last; ++i) {
    const double ratio = parts / static_cast<double>(last - i);
    Piece higher = next;
    extrapolate(row[i], 1.0 / (ratio * ratio - 1.0), higher);
    row[i] = std::exchange(next, higher);
  }
  row[last] = next;
  return row[last];
}

/// Of the numbers that tell where the pieces end, in the size that the motion, the friction or a
/// period's impulse has; the largest one, as a multiple of what is allowed.
double ChangingPlant::difference(const Piece& coarse, const Piece& fine) const {
  constexpr double rounding = 1e-12;
  const double allowed = std::max(rounding, share_of_tolerance * solver_.tolerance);
  double largest = 0.0;
  const auto compare = [&](double one, double other, double size) {
    const double apart = std::abs(one - other) / (allowed * size + 4e-16 * std::abs(one));
    if (one != other && !(apart <= largest)) {
      largest = std::isnan(apart) ? std::numeric_limits<double>::infinity() : apart;
    }
  };
  const PlantState& one = coarse.end.state;
  const PlantState& other = fine.end.state;
  const double omega = scales_.angular_frequency_rad_per_s;
  const double velocity_m_per_s =
      std::max(scales_.velocity_m_per_s(), std::abs(one.velocity_m_per_s));
  compare(one.velocity_m_per_s, other.velocity_m_per_s, velocity_m_per_s);
  compare(one.displacement_m, other.displacement_m, velocity_m_per_s / omega);
  compare(coarse.energy.friction_impulse_N_s, fine.energy.friction_impulse_N_s,
          largest_limit_N_ * numeric::two_pi / omega);
  for (std::size_t i = 0; i < coarse.end.forces_N.size(); ++i) {
    compare(coarse.end.forces_N[i], fine.end.forces_N[i], largest_limit_N_);
  }
  return largest;
}

}  // namespace sonoglide::loop
