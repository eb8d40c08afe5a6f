/// Text as a cell of a table.
#pragma once

#include <string>
#include <string_view>

namespace sonoglide::text {

/// A text as a cell of CSV (RFC 4180): in quotes where it has a comma or a quote, printable (see
/// printable()), so that a row is a line.
std::string csv_cell(std::string_view text);

}  // namespace sonoglide::text
