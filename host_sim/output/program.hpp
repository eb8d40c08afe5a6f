/// What the running program was asked to do. Every page and every JSON file says it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace sonoglide::output {

/// Set once, by the command line, before anything is computed: no thread reads it earlier. What uses
/// the rooms as a library leaves it empty.
struct Program {
  std::string command_line;  ///< as a shell takes it, printable(); empty: there is none
  /// See scene_file::changes(): the scene's keys that `--set` gave another value than the file.
  nlohmann::ordered_json changed = nlohmann::ordered_json::object();
};

Program& program();

/// `version`, `command_line` (null where there is none) and `changed`; stands under `program` in
/// every JSON file: `json["program"] = output::program_json();`.
nlohmann::ordered_json program_json();

}  // namespace sonoglide::output
