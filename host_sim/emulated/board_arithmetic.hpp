/// Which arithmetic a board is made for.
#pragma once

#include "host_sim/emulated/board_list.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::emulated {

/// @throws scene::ConfigurationError  a float64 scene on a board that computes that in software
void require_arithmetic(const scene::Scene& scene, const emulated::EmulatedBoard& board);

}  // namespace sonoglide::emulated
