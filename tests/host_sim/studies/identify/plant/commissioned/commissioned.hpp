/// A plant at random about that of a scene, identified as a unit would, and the loop before and after.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "host_sim/configure/experiment.hpp"

namespace sonoglide::identify::plant::test {

/// The scene that the controllers of random plants are designed for: a file, with a force converter of 12 bits.
configure::Experiment nominal_experiment(const std::string& file);

struct Commissioned {
  static constexpr std::array keys = {"plant.stiffness_N_per_m", "friction.coefficient",
                                      "friction.contact_stiffness_N_per_m"};
  std::array<double, keys.size()> truth;  ///< over the nominal value: within 20, 30 and 50 % of it
  std::array<double, keys.size()> error;  ///< of what was found, relative
  std::array<bool, keys.size()> covered;  ///< the interval has the truth
  bool warned;
  // Steps of the scene that settle within a millisecond on the true plant:
  int as_designed;
  int commissioned;
  int exact;  ///< with a controller that is designed for the true plant
};

/// The same seed, the same plant.
Commissioned commissioned(const std::string& file, std::uint64_t seed);

/// As a line of plants.csv; columns() are its names.
std::string row(std::uint64_t seed, const Commissioned& found);
std::string columns();

}  // namespace sonoglide::identify::plant::test
