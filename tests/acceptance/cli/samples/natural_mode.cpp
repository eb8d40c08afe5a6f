#include "tests/acceptance/cli/samples/natural_mode.hpp"

#include <fmt/format.h>

#include <cmath>

#include "firmware/numeric/turn.hpp"
#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/output/number.hpp"

namespace sonoglide::natural_mode {

double frequency_Hz(const scene::Plant& plant) {
  if (plant.stiffness_N_per_m == 0.0) {
    throw configure::ConfigurationError("plant.stiffness_N_per_m",
                                        "a free mass has no natural mode; allowed: above 0 N/m");
  }
  return std::sqrt(plant.stiffness_N_per_m / plant.mass_kg) / numeric::two_pi;
}

std::string table(const scene::Scene& scene) {
  return fmt::format("scene,natural_mode_Hz\n{},{}\n", output::csv_cell(scene.name),
                     output::csv_number(frequency_Hz(scene.plant), 17));
}

}  // namespace sonoglide::natural_mode
