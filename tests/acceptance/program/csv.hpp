/// The program's tables, read back.
#pragma once

#include <string>
#include <vector>

namespace sonoglide::acceptance {

using Cells = std::vector<std::string>;

/// Every line of a table, its heading first; an empty last cell counts.
std::vector<Cells> csv_rows(const std::string& text);

}  // namespace sonoglide::acceptance
