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

/// A Dahl contact with Kt X/Fc near 2.
inline std::string measured_friction() {
  return "velocity_ratio,sliding_velocity_m_per_s,frequency_Hz,friction_ratio\n"
         "0.1,0.01,26e3,0.0886\n0.3,0.03,26e3,0.271\n0.5,0.05,26e3,0.4899\n"
         "0.7,0.07,26e3,0.735\n0.9,0.09,26e3,0.9449\n";
}

class SceneFolder : public ScratchFolder {
 public:
  SceneFolder() {
    write("measured.csv", measured_sweep());
    write("friction.csv", measured_friction());
    for (const char* file : {"open.toml", "closed.toml", "uncertain.toml"}) {
      write(file, text_of_scene(file));
    }
  }
};

/// The words of a command with another scene than the table's.
inline std::string words_with_scene(const Command& command, const std::string& scene) {
  // No serial device.
  const char* const device = command.effort == Effort::device ? " /dev/null" : "";
  return command.name + device + " " + scene + " " + command.arguments;
}

inline std::string words(const Command& command) {
  return words_with_scene(command, command.scene);
}

}  // namespace sonoglide::acceptance
