/// In what a scene differs from its file.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "host_sim/scene_file/source.hpp"

namespace sonoglide::scene_file {

/// The keys to which `--set` gives another value than the file does, in the order of the options:
/// `{"drive.frequency_Hz": {"file": 60000.0, "value": 61000.0}}`, null where there is none.
/// @throws SceneError  as Document does
nlohmann::ordered_json changes(const Source& source, const std::vector<std::string>& overrides);

}  // namespace sonoglide::scene_file
