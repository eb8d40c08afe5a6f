/// What a scene asks of the board that its controller is built for.
#pragma once

#include "host_sim/boards/emulated/board_list.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::emulated {

/// @throws configure::ConfigurationError  a float64 scene on a board that computes that in software
void require_arithmetic(const scene::Scene& scene, const ImageBoard& board);

/// @throws configure::ConfigurationError  what a board of carrier_boards() has no time for, or cannot show to
///         its image or do with its answers
void require_carrier_board(const scene::Scene& scene, const EmulatedBoard& board);

}  // namespace sonoglide::emulated
