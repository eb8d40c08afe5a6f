/// The study of the sample command: the natural mode of a plant.
#pragma once

#include <string>

#include "host_sim/scene/scene.hpp"

namespace sonoglide::natural_mode {

/// sqrt(Ks/m) / 2π [Hz].
/// @throws configure::ConfigurationError  a free mass has none
double frequency_Hz(const scene::Plant& plant);

/// The heading, and a row with the scene's name and its frequency.
std::string table(const scene::Scene& scene);

}  // namespace sonoglide::natural_mode
