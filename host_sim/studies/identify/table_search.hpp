/// Where the table of a text is.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "host_sim/scene_file/source.hpp"
#include "host_sim/studies/identify/text_file.hpp"

namespace sonoglide::identify {

/// The names of the columns.
struct Heading {
  std::vector<std::string> names;
  std::vector<std::size_t> places;  ///< of the names in their line, from 1
  std::size_t line = 1;
  char separator = ',';
};

/// The line as a heading: as many cells at least, none of them a number. Without names it is none.
Heading heading_of(const Line& line, std::size_t least_cells);

/// Whether names are those of the table that is wanted.
using IsWanted = std::function<bool(const std::vector<std::string>& names)>;

struct FoundTable {
  Heading heading;
  std::vector<Line> rows;
  std::vector<std::string> warnings;  ///< each a sentence
};

/// The heading is the line of words above rows of numbers that is wanted; of several the one with
/// the most rows, then the last. A line of units
/// below it is joined to it in brackets. The rows end at a line `END`, at a line that does not begin
/// with a number, or at the end of the text.
/// @throws scene_file::SceneError  no heading, a second table, or rows below the end of the table
FoundTable find_table(const scene_file::Source& source, const IsWanted& is_wanted);

}  // namespace sonoglide::identify
