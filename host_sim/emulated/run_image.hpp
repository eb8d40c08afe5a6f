/// A closed loop with the real image of its controller.
#pragma once

#include <string>

#include "host_sim/configure/control_design.hpp"
#include "host_sim/emulated/board_list.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/process/pipe.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::emulated {

/// Builds and measures the image of a controller, runs the scene with it on an emulated board, and
/// once more with the controller in this process, which should come to the same drive commands.
///
/// @param design     of the scene's controller
/// @param header     of the same, as emulated::controller_header() writes it
/// @return with the image's record
/// @throws process::ProcessError  a tool is missing, or the build failed
/// @throws EmulatorError          the image did not answer, or not in order
/// @throws what loop::run() throws, besides
loop::RunResult run_image(const scene::Scene& scene, const configure::ControlDesign& design,
                          const emulated::EmulatedBoard& board, const std::string& header,
                          const loop::Watch& watch);

/// @param result  of run_image()
/// @throws loop::ComputationError  the image's drive commands are not the workstation's
void require_same(const loop::RunResult& result);

}  // namespace sonoglide::emulated
