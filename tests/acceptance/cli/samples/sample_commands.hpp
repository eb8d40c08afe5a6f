/// The list of a program that has one command more, as commands.hpp would have it.
#pragma once

namespace CLI {
class App;
}

namespace sonoglide::cli {

void add_natural_mode_command(CLI::App& program);

}  // namespace sonoglide::cli
