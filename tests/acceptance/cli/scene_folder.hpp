/// A folder with the scenes of the table of commands.
#pragma once

#include <string>

#include "command_table.hpp"
#include "short_scenes.hpp"
#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance {

inline const std::string recorded_open_loop = short_open_loop + R"(record = ["displacement_m"]
record_interval_s = 1e-6
)";

inline const std::string uncertain_closed_loop =
    short_closed_loop + "[tolerance]\n\"plant.stiffness_N_per_m\" = 0.02\n";

/// The text of a scene of the table.
inline const std::string& text_of_scene(const std::string& file) {
  return file == "closed.toml"      ? short_closed_loop
         : file == "uncertain.toml" ? uncertain_closed_loop
                                    : recorded_open_loop;
}

/// A sweep of a transducer of 3 nF with a resonance at 40 kHz, Q 50.
inline std::string measured_sweep() {
  std::string text = "frequency_Hz,conductance_S,susceptance_S\n";
  for (int i = 0; i <= 60; ++i) {
    const double f = 38e3 + 100.0 * i;
    const double detuning = (f / 40e3 - 40e3 / f) * 50.0;
    const double share = 2e-3 / (1.0 + detuning * detuning);
    // Errors of the last digit that an instrument shows.
    const double susceptance_S = 6.283185307179586 * f * 3e-9 - share * detuning;
    text += std::to_string(f) + "," + std::to_string(share) + "," + std::to_string(susceptance_S) +
            "\n";
  }
  return text;
}

class SceneFolder : public ScratchFolder {
 public:
  SceneFolder() {
    write("measured.csv", measured_sweep());
    for (const char* file : {"open.toml", "closed.toml", "uncertain.toml"}) {
      write(file, text_of_scene(file));
    }
  }
};

/// The words of a command with another scene than the table's.
inline std::string words_with_scene(const Command& command, const std::string& scene) {
  return command.name + " " + scene + " " + command.arguments;
}

inline std::string words(const Command& command) {
  return words_with_scene(command, command.scene);
}

}  // namespace sonoglide::acceptance
