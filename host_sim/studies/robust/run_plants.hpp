/// Many plants under one controller.
#pragma once

#include <vector>

#include "host_sim/configure/control_design.hpp"
#include "host_sim/scene/scene.hpp"
#include "host_sim/studies/robust/row.hpp"

namespace sonoglide::robust {

/// Runs each of the plants with a controller of this design: those that suit SIMD lanes together in
/// them, the others, and what the lanes give up, one after the other as `run` does. A row depends on
/// its plant alone, to the bit; a computation that fails gives a row that says why. Safe to call from
/// several threads.
/// @param plants  closed-loop scenes for which the design was made: they differ in true values alone
std::vector<PlantRow> run_plants(const std::vector<scene::Scene>& plants,
                                 const configure::ControlDesign& design);

}  // namespace sonoglide::robust
