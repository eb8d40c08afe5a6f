/// A design on one page, to be read and printed.
#pragma once

#include "host_sim/output/page.hpp"
#include "host_sim/studies/design/study.hpp"

namespace sonoglide::design {

/// @throws process::ProcessError  of the pictures
output::Page page(const Study& study);

}  // namespace sonoglide::design
