/// The cells of a line.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace sonoglide::identify {

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

}  // namespace sonoglide::identify
