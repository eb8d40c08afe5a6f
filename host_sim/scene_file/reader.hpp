/// A scene file to a validated scene, without what follows from the design of its controller.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "host_sim/scene/scene.hpp"
#include "host_sim/scene_file/document.hpp"
#include "host_sim/scene_file/scene_error.hpp"
#include "host_sim/scene_file/source.hpp"
#include "host_sim/scene_file/variant.hpp"

namespace sonoglide::scene_file {

/// Reads, overrides, checks and completes a scene.
///
/// Errors come one at a time, in a fixed order: TOML, names that no scene has (in file order),
/// overrides (in their order), then the values, table by table in the order of key_tables().
///
/// @param path       a file, or `-` for standard input
/// @param overrides  `TABLE.KEY=VALUE` each, VALUE in TOML or a bare word; without VALUE the key is
///                   removed; applied before anything is checked, a later one wins
/// @throws SceneError  and nothing else, short of memory running out
scene::Scene read_file(const std::filesystem::path& path,
                       const std::vector<std::string>& overrides = {});

/// The same from a text that is there already.
scene::Scene read(const Source& source, const std::vector<std::string>& overrides = {});

/// The same from text.
///
/// @param file  what errors show as the file; the scene's name is this without folder and ending
scene::Scene read_text(std::string_view text, const std::string& file,
                       const std::vector<std::string>& overrides = {});

/// The scene of a parsed document, with all checks of values, for the same errors as by text: a
/// value stands where `--set KEY=VALUE` would, after the document's own overrides. Open loop
/// takes about a microsecond. Safe to call from several threads.
///
/// @param values  of the document's varied keys, in their order, not fewer
/// @param unused  takes the keys that the scene cannot use; null: each of them is an error
/// @throws SceneError
scene::Scene read(const Document& document, const std::vector<VariedValue>& values = {},
                  UnusedKeys* unused = nullptr);

/// The scene with its true values in the place of those that it states.
///
/// @param stated  as read() has it; of the varied values only true ones may be others
/// @throws SceneError  together the values are those of no plant
scene::Scene read_truth(const Document& document, const std::vector<VariedValue>& values,
                        const scene::Scene& stated);

}  // namespace sonoglide::scene_file
