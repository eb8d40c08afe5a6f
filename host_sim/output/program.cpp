#include "host_sim/output/program.hpp"

namespace sonoglide::output {

Program& program() {
  static Program the_program;
  return the_program;
}

nlohmann::ordered_json program_json() {
  const Program& asked = program();
  return {{"version", SONOGLIDE_VERSION},
          {"command_line", asked.command_line.empty() ? nlohmann::ordered_json(nullptr)
                                                      : nlohmann::ordered_json(asked.command_line)},
          {"changed", asked.changed}};
}

}  // namespace sonoglide::output
