/// Many plants under one controller.
#pragma once

#include <functional>
#include <vector>

#include "host_sim/configure/control_design.hpp"
#include "host_sim/scene/scene.hpp"
#include "host_sim/studies/robust/row.hpp"

namespace sonoglide::robust {

/// Takes rows, by the places of their plants, from any thread.
using TakeRows = std::function<void(std::vector<Record> rows)>;

/// Runs each of the plants with a controller of this design, on all threads: those that suit SIMD
/// lanes in them, the others, and what the lanes give up, as `run` does. A row depends on its plant
/// alone, to the bit; a computation that fails gives a row that says why.
/// @param plants  closed-loop scenes for which the design was made: they differ in true values alone
void run_plants(const std::vector<scene::Scene>& plants, const configure::ControlDesign& design,
                const TakeRows& take);
std::vector<PlantRow> run_plants(const std::vector<scene::Scene>& plants,
                                 const configure::ControlDesign& design);

}  // namespace sonoglide::robust
