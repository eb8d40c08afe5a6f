/// A page with every kind of panel that a report has, filled from closed forms.
#pragma once

#include "host_sim/output/page.hpp"

namespace sonoglide::report {

output::Page sample_page();

}  // namespace sonoglide::report
