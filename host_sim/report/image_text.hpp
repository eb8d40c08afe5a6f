/// What an image cost, in words.
#pragma once

#include <string>

#include "host_sim/loop/image_record.hpp"
#include "host_sim/output/page.hpp"

namespace sonoglide::report {

/// Every figure with its name.
output::Table image_table(const loop::ImageRecord& record);

/// The same in two lines.
std::string image_lines(const loop::ImageRecord& record);

}  // namespace sonoglide::report
