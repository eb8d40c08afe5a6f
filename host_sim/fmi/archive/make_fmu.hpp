/// An FMU: a scene packed with the engine, the description and the sources.
#pragma once

#include <filesystem>
#include <string>

#include "host_sim/fmi/archive/model_description.hpp"
#include "host_sim/fmi/content.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::fmi {

/// What stands beside the program.
struct Parts {
  std::filesystem::path engine;   ///< the shared library of every FMU
  std::filesystem::path sources;  ///< the source tree
};

/// @throws output::OutputError  they are not there
Parts find_parts();

/// The content of the archive, the same bytes for one scene each time.
/// @param scene    usable, see require_usable() and, with a clock, clock_resolution_Hz()
/// @param content  a clock only of FMI 3.0
/// @param tool     that makes it, with its version
/// @throws output::OutputError
std::string make_fmu(const scene::Scene& scene, Content content, Version version,
                     const Parts& parts, const std::string& tool);

}  // namespace sonoglide::fmi
