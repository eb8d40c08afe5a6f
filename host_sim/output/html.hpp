/// Parts of a page as HTML.
#pragma once

#include <string>
#include <string_view>

#include "host_sim/output/page.hpp"

namespace sonoglide::output {

/// Fit for elements and for attributes in either kind of quotes.
std::string escaped(std::string_view text);

/// Nothing for an empty text.
void append_paragraph(std::string& html, std::string_view css_class, const std::string& text);

/// @throws std::invalid_argument  a row has not one cell for each heading
void check(const Table& table);
void append_table(std::string& html, const Table& table);

/// The command, the version, the seed, and the scene with its changed values marked.
void append_what_was_run(std::string& html, const Page& page);

}  // namespace sonoglide::output
