/// A page as HTML: its parts, and the files that go into every page.
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

// Built into the program (see assets.cmake).

std::string_view page_css();
// In this order.
std::string_view numbers_js();
std::string_view look_js();
std::string_view chart_js();
std::string_view reading_js();
std::string_view panel_js();
std::string_view wide_js();
std::string_view page_js();
std::string_view glossary_md();
std::string_view control_md();

/// Each symbol and each term of the glossary that the page uses, and each symbol in their meanings, in a
/// folded table; symbols first.
///
/// A term may stand in the plural and begin a sentence. Inside a longer term it is not looked for. A
/// letter behind a number, or in square brackets, is a unit and no symbol. The scene and the command
/// that were run are left aside.
Table words_of(const Page& page);

}  // namespace sonoglide::output
