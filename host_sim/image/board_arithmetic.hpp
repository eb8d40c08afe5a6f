/// Which arithmetic a board is made for.
#pragma once

#include "host_sim/emulator/board_list.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::image {

/// @throws scene::ConfigurationError  a float64 scene on a board that computes that in software
void require_arithmetic(const scene::Scene& scene, const emulator::EmulatedBoard& board);

}  // namespace sonoglide::image
