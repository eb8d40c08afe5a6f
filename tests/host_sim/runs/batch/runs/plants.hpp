/// Plants that the batch tests run.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "host_sim/runs/batch/run_dahl_plants.hpp"
#include "tests/common/constants/table_1_numbers.hpp"

namespace sonoglide::batch {

/// Table 1 at 384 N from rest, swept over velocity ratio 0.05 to 1.2 and, in equal ratios, contact
/// stiffness 1e4 to 1e6 N/m: `side` by `side` points.
inline std::vector<DahlPlant> table_1_sweep(std::size_t side) {
  using tests::Table1;
  constexpr double force_N = 384.0;
  constexpr double friction_N = Table1::friction_limit_N;
  constexpr double length_m = force_N / Table1::inertia_N_per_m;
  std::vector<DahlPlant> plants;
  for (std::size_t i = 0; i < side; ++i) {
    for (std::size_t j = 0; j < side; ++j) {
      const double last = static_cast<double>(side - 1);
      const double velocity_ratio = 0.05 + 1.15 * static_cast<double>(i) / last;
      const double contact_N_per_m = 1e4 * std::pow(100.0, static_cast<double>(j) / last);
      DahlPlant plant;
      plant.stiffness = Table1::stiffness_N_per_m / Table1::inertia_N_per_m;
      plant.friction_force = friction_N / force_N;
      plant.contact_stiffness = contact_N_per_m * length_m / friction_N;
      plant.sliding_velocity = velocity_ratio / (1.0 - plant.stiffness);
      plants.push_back(plant);
    }
  }
  return plants;
}

/// Soft to stiff contacts, light to heavy friction, below and above resonance and at it, damped or
/// not, either sign of r and sigma, any initial state.
inline std::vector<DahlPlant> random_plants(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  const auto uniform = [&generator](double low, double high) {
    return low + (high - low) * static_cast<double>(generator() >> 11) * 0x1p-53;
  };
  std::vector<DahlPlant> plants(count);
  for (std::size_t i = 0; i < count; ++i) {
    DahlPlant& plant = plants[i];
    plant.contact_stiffness = std::pow(10.0, uniform(-3.0, 4.0));
    plant.friction_force = std::pow(10.0, uniform(-6.0, 0.0));
    plant.damping = i % 2 == 0 ? 0.0 : std::pow(10.0, uniform(-4.0, 0.5));
    plant.stiffness = i % 5 == 0 ? 1.0 : std::pow(10.0, uniform(-3.0, 1.0));
    plant.sliding_velocity = uniform(-1.5, 1.5);
    plant.vibration_sign = i % 7 == 0 ? -1.0 : 1.0;
    plant.initial = {uniform(-1.0, 1.0), uniform(-1.0, 1.0), uniform(-1.0, 1.0)};
  }
  return plants;
}

}  // namespace sonoglide::batch
