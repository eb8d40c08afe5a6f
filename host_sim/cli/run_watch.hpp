/// What the commands that simulate a scene watch it with.
#pragma once

#include "host_sim/cli/progress_bar.hpp"
#include "host_sim/loop/watch.hpp"
#include "host_sim/process/interruption.hpp"
#include "host_sim/report/run_report.hpp"

namespace sonoglide::cli {

/// The progress bar, and an end to the run when somebody interrupts it. Both outlive it.
loop::Progress watching(ProgressBar& bar, const process::Interruption& interruption);

/// The report's sinks, the progress bar, and an end to the run when somebody interrupts it. All
/// three outlive the watch.
loop::Watch run_watch(report::RunReport& report, ProgressBar& bar,
                      const process::Interruption& interruption);

}  // namespace sonoglide::cli
