/// An FMU: a scene packed with the engine, the description and the licences.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "host_sim/loop/stepped.hpp"
#include "host_sim/scene/names.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::fmi {

// Texts of an FMU: modelDescription.xml and the licences.

enum class Version { fmi2, fmi3 };

/// The first where none is named.
inline constexpr std::array versions = {scene::Named<Version>{"3", Version::fmi3},
                                        scene::Named<Version>{"2", Version::fmi2}};

struct ModelFacts {
  std::string name;        ///< of the scene, printable
  std::string identifier;  ///< of the shared library, without its ending
  std::string token;
  std::string tool;  ///< that wrote it, with its version
};

/// @param experiment  as the FMU holds it, see variables()
/// Source: Functional Mock-up Interface Specification 3.0, section 2.4, and 2.0.4, section 2.2.
std::string model_description(const configure::Experiment& experiment, loop::Kind kind,
                              Version version, const ModelFacts& facts);

std::string_view our_licence();
/// Of the libraries that are compiled into the engines.
std::string_view compiled_in_licences();

/// The engine of every FMU.
struct Parts {
  std::filesystem::path engine;                         ///< for this machine
  std::optional<std::filesystem::path> windows_engine;  ///< absent where it was not built
};

/// Where they stand for the program: `lib/sonoglide` beside its folder.
std::filesystem::path folder_of_program();

/// @throws process::FileError  the engine for this machine is not in the folder
Parts find_parts(const std::filesystem::path& folder);

/// The content of the archive, the same bytes for one scene each time.
/// @param scene  usable, see require_usable()
/// @param tool   that makes it, with its version
/// @throws process::FileError
std::string make_fmu(const scene::Scene& scene, loop::Kind kind, Version version,
                     const Parts& parts, const std::string& tool);

}  // namespace sonoglide::fmi
