/// A panel as the JSON that page.js draws.
#pragma once

#include <string>

#include "host_sim/output/page.hpp"

namespace sonoglide::output {

/// JSON that is safe inside an HTML script element (no '<'); NaN and infinities become null.
std::string chart_json(const Panel& panel);

/// Whether the panel has a value that its axes can show.
bool has_something_to_draw(const Panel& panel);

}  // namespace sonoglide::output
