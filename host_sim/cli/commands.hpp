/// The commands of the program: the one place that lists them. Each is a file of its own,
/// NAME_command.cpp.
#pragma once

#include <array>

namespace CLI {
class App;
}

namespace sonoglide::cli {

// Each adds its command, with its options, to the program. What a command throws ends the program
// with the exit code that program.cpp gives it; nothing was written then.
void add_run_command(CLI::App& program);
void add_pil_command(CLI::App& program);
void add_image_command(CLI::App& program);
void add_configure_command(CLI::App& program);
/// Talks to a unit until its standard input ends.
void add_connect_command(CLI::App& program);
/// Drives a unit through a sequence of targets, then stops it.
void add_commission_command(CLI::App& program);
void add_ratio_command(CLI::App& program);
void add_sweep_command(CLI::App& program);
void add_robust_command(CLI::App& program);
void add_paper_command(CLI::App& program);
void add_work_precision_command(CLI::App& program);
void add_stability_command(CLI::App& program);
void add_arithmetic_command(CLI::App& program);
void add_design_command(CLI::App& program);
/// A group: what it identifies are commands of their own.
void add_identify_command(CLI::App& program);
void add_fmu_command(CLI::App& program);
/// Prints the JSON Schema of scenes alone.
void add_schema_command(CLI::App& program);
/// Prints a shell's completion script alone.
void add_completion_command(CLI::App& program);
/// What that script asks; the help does not list it.
void add_complete_command(CLI::App& program);

/// In the order of the help.
inline constexpr std::array commands = {
    add_run_command,
    add_pil_command,
    add_image_command,
    add_connect_command,
    add_commission_command,
    add_configure_command,
    add_ratio_command,
    add_sweep_command,
    add_robust_command,
    add_paper_command,
    add_work_precision_command,
    add_stability_command,
    add_arithmetic_command,
    add_design_command,
    add_identify_command,
    add_fmu_command,
    add_schema_command,
    add_completion_command,
    add_complete_command,
};

}  // namespace sonoglide::cli
