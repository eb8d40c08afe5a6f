/// The words by which reports name the controller's limits and faults.
#pragma once

#include <string>

#include "firmware/control/drive_command.hpp"
#include "host_sim/report/step_metrics.hpp"

namespace sonoglide::report {

std::string limit_name(control::Limit limit);
std::string fault_name(control::Fault fault);
/// The limit of a target step, with its cause, how far belief and truth are apart, and whether only
/// the simulation can see it; all where there is something to say.
std::string limit_text(const report::StepMetrics& step);
std::string settling_name(control::Settling settling);

}  // namespace sonoglide::report
