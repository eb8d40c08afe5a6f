/// The commands of the group `identify`. Each is a file of its own, identify_NAME_command.cpp.
#pragma once

namespace CLI {
class App;
}

namespace sonoglide::cli {

void add_identify_impedance_command(CLI::App& group);
void add_identify_friction_command(CLI::App& group);

}  // namespace sonoglide::cli
