/// Scene files whose controllers are designed: what every command begins with.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "host_sim/configure/experiment.hpp"
#include "host_sim/scene_file/document.hpp"
#include "host_sim/scene_file/scene_error.hpp"
#include "host_sim/scene_file/source.hpp"
#include "host_sim/scene_file/variant.hpp"

namespace sonoglide::experiment {

using configure::Experiment;

/// As scene_file::read_file(), takes the true values into account, and designs the controller of a
/// closed loop.
/// @throws scene_file::SceneError  what makes it unusable, or why no controller can be designed, at
///                                 the place of its key
Experiment read_file(const std::filesystem::path& path,
                     const std::vector<std::string>& overrides = {});

/// The same from a text that is there already.
Experiment read(const scene_file::Source& source, const std::vector<std::string>& overrides = {});

/// The same from text, as scene_file::read_text().
Experiment read_text(std::string_view text, const std::string& file,
                     const std::vector<std::string>& overrides = {});

/// The same from a document, as scene_file::read().
Experiment read(const scene_file::Document& document,
                const std::vector<scene_file::VariedValue>& values = {},
                scene_file::UnusedKeys* unused = nullptr);

/// The scene in JSON, a table each, as scene_file::to_json().
nlohmann::ordered_json echo_of(const scene::Scene& scene);

/// The scene as a file, from which it is read again.
std::string text_of(const scene::Scene& scene);

}  // namespace sonoglide::experiment
