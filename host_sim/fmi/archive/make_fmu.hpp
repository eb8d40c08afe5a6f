/// An FMU: a scene packed with the engine, the description and the licences.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "host_sim/fmi/archive/model_description.hpp"
#include "host_sim/loop/stepped.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::fmi {

/// What stands beside the program: the engine of every FMU.
struct Parts {
  std::filesystem::path engine;                         ///< for this machine
  std::optional<std::filesystem::path> windows_engine;  ///< absent where it was not built
};

/// @throws output::OutputError  the engine for this machine is not there
Parts find_parts();

/// The content of the archive, the same bytes for one scene each time.
/// @param scene  usable, see require_usable()
/// @param tool   that makes it, with its version
/// @throws output::OutputError
std::string make_fmu(const scene::Scene& scene, loop::Kind kind, Version version,
                     const Parts& parts, const std::string& tool);

}  // namespace sonoglide::fmi
