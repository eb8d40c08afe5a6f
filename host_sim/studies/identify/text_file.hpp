/// Files of measurements as lines of text, and the cells of these.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host_sim/scene_file/scene_error.hpp"
#include "host_sim/scene_file/source.hpp"

namespace sonoglide::identify {

/// The largest file that is read, and the most lines that are no blank ones.
inline constexpr std::size_t most_bytes = std::size_t{256} << 20U;
inline constexpr std::size_t most_lines = 1'000'000;

/// The text of a file of measurements, without a byte order mark; of text in UTF-16 its UTF-8.
/// @throws scene_file::SceneError  it cannot be read, is empty, larger than most_bytes, or no text
scene_file::Source read_text(const std::filesystem::path& path);

struct Line {
  std::string_view text;
  std::size_t number;  ///< from 1
};

/// The lines that are not blank, without their ends: LF, CR LF or CR. Views of the text.
/// @throws scene_file::SceneError  they are more than most_lines
std::vector<Line> lines_of(const scene_file::Source& source);

/// Cells of a line that are looked at: of more the first most_cells + 1.
inline constexpr std::size_t most_cells = 1000;

/// Without the blanks and quotes around it, with its column in the line, from 1.
struct Cell {
  std::string_view text;
  std::size_t column;
};

/// @param separator  a blank stands for any number of blanks and tabs
std::vector<Cell> cells_of(std::string_view line, char separator);

/// A finite number, with a decimal point or, where no comma separates cells, a decimal comma.
/// Unicode's minus and its spaces between groups of three digits are understood.
std::optional<double> number_of(std::string_view cell, char separator = ' ');

/// number_of(), or not a number.
bool is_numeric(std::string_view cell, char separator);

/// Whether a line begins with `#`, `!` or `%`.
bool is_comment(std::string_view line);

/// A warning of a text whose last line has no end, and so may be cut; empty for any other.
std::string warning_of_cut(const scene_file::Source& source);

// The signs of instruments and spreadsheets as ASCII.

/// Without the blanks of ASCII around it.
std::string_view trimmed(std::string_view text);

/// The beginning of a text in valid UTF-8, for a message.
std::string shortened(std::string_view text);

std::string lower_case(std::string_view text);

/// Whether a word is one of a list, each between blanks.
bool is_among(std::string_view word, std::string_view list);

/// The same text with ASCII words for signs: `Ohm` for both omegas, `u` for both micro signs, `deg`,
/// `theta`, `phi`, `angle`, `^-6` for superscripts, `*` for multiplication signs, `-` for Unicode's
/// minus and dashes, a space for its spaces, English for Chinese and Japanese words. The words of
/// LaTeX (`k\Omega`, `^\circ`) and the signs of Latin-1 are understood too. What is left beyond ASCII
/// has no such spelling.
std::string plain_text(std::string_view text);

}  // namespace sonoglide::identify
