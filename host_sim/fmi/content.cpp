#include "host_sim/fmi/content.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host_sim/configure/configuration_error.hpp"

namespace sonoglide::fmi {

std::uint64_t clock_resolution_Hz(const scene::Scene& scene) {
  const double frequency_Hz = scene.drive->frequency_Hz;
  if (!(frequency_Hz >= 1.0 && frequency_Hz == std::floor(frequency_Hz))) {
    throw configure::ConfigurationError(
        "drive.frequency_Hz",
        fmt::format("is {}, and the interval of a clock is a fraction of whole numbers; allowed "
                    "with a clock: a whole number of Hz",
                    frequency_Hz));
  }
  return static_cast<std::uint64_t>(frequency_Hz);
}

}  // namespace sonoglide::fmi
