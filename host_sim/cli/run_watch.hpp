/// What the commands that simulate a scene tell of it and watch it with.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host_sim/cli/progress_bar.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/loop/watch.hpp"
#include "host_sim/report/run_report.hpp"

namespace sonoglide::cli {

/// Prints notes on standard error, each in a line.
void print_notes(const std::vector<std::string>& notes);

/// Prints the notes of a controller's design; none in open loop.
void print_design_notes(const std::optional<configure::ControlDesign>& design);

/// Tells the steps of work that will take a minute or more of a core, before it begins.
void announce_long_work(double expected_steps);

/// The progress bar, which outlives it.
loop::Progress watching(ProgressBar& bar);

/// The report's sinks and the progress bar. Both outlive the watch.
loop::Watch run_watch(report::RunReport& report, ProgressBar& bar);

}  // namespace sonoglide::cli
