/// The words by which reports name the controller's limits and faults.
#pragma once

#include <string>

#include "firmware/control/drive_command.hpp"

namespace sonoglide::report {

std::string limit_name(control::Limit limit);
std::string fault_name(control::Fault fault);

}  // namespace sonoglide::report
