/// Text of unknown origin, fit to be shown.
#pragma once

#include <string>
#include <string_view>

namespace sonoglide::process {

/// The text in valid UTF-8 on one line: every byte of a control character (C0, DEL, C1, the line
/// and paragraph separators), of a character that turns the direction of writing, of U+FFFE and
/// U+FFFF, which XML cannot hold, and every byte that is not UTF-8 stands as `\xNN`. What is
/// printable already is not changed, so that a second call changes nothing.
///
/// Names of files may hold anything but `/` and NUL: this is what keeps them from speaking to a
/// terminal and from breaking a line, JSON, XML or a comment. The quotes of each language come on
/// top.
/// Source: Unicode 15.0, tables 3-7 (well-formed UTF-8) and 23-3 (bidirectional controls).
std::string printable(std::string_view text);

/// The same, line by line: line feeds and tabs stay. For text of several lines.
std::string printable_lines(std::string_view text);

/// Shows printable_lines of the text and a line feed on standard error. Where that cannot be
/// written, nobody can be told, and the program goes on.
void show_on_stderr(std::string_view text);

}  // namespace sonoglide::process
