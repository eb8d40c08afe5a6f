/// Texts of an FMU: modelDescription.xml and the licences.
#pragma once

#include <string>
#include <string_view>

#include "host_sim/loop/stepped.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::fmi {

enum class Version { fmi2, fmi3 };

struct ModelFacts {
  std::string name;        ///< of the scene, printable
  std::string identifier;  ///< of the shared library, without its ending
  std::string token;
  std::string tool;  ///< that wrote it, with its version
};

/// @param scene  as the FMU holds it, see variables()
/// Source: Functional Mock-up Interface Specification 3.0, section 2.4, and 2.0.4, section 2.2.
std::string model_description(const scene::Scene& scene, loop::Kind kind, Version version,
                              const ModelFacts& facts);

std::string_view our_licence();
/// Of the libraries that are compiled into the engines.
std::string_view compiled_in_licences();

}  // namespace sonoglide::fmi
