/// What the measurement was made on.
#pragma once

#include <string>

namespace sonoglide::work_precision {

/// Processor and compiler, in one line.
std::string machine();

}  // namespace sonoglide::work_precision
