/// A design on one page, to be read and printed.
#pragma once

#include "host_sim/design/study.hpp"
#include "host_sim/report/page.hpp"

namespace sonoglide::design {

/// @throws process::ProcessError  of the pictures
report::Page page(const Study& study);

}  // namespace sonoglide::design
