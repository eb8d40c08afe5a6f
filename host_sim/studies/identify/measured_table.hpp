/// A table of measurements as instruments and spreadsheets write it: text with named columns.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "host_sim/scene_file/scene_error.hpp"
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

/// The heading is the line of words above rows of numbers that is wanted; of several the one with the
/// most rows, then the last. Units on the line below or above it are joined to it in brackets. The
/// rows end at a line `END`, at a line that does not begin with a number, or at the end of the text.
/// @throws scene_file::SceneError  no heading, a second table, or rows below the end of the table
FoundTable find_table(const scene_file::Source& source, const IsWanted& is_wanted);

/// What stands in the last brackets of a name; empty where nothing does.
std::string unit_in_brackets(const std::string& name);

/// Columns of numbers under a heading. The separator is a tab, a semicolon, a comma or blanks,
/// whichever the heading has first in this order. With any but a comma the numbers may have decimal
/// commas, and then none has a decimal point. Lines that begin with `#`, `!` or `%` are comments; one
/// of them may be the heading.
class MeasuredTable {
 public:
  /// @param source  outlives the table
  /// @throws scene_file::SceneError  no row, a row of more cells than the heading, or decimal points
  ///         beside decimal commas
  MeasuredTable(const scene_file::Source& source, FoundTable found);

  const std::vector<std::string>& names() const { return found_.heading.names; }
  std::size_t rows() const { return found_.rows.size(); }
  /// Each a sentence: what of the text is not read, and how numbers are, and that it may be cut.
  const std::vector<std::string>& warnings() const { return found_.warnings; }

  /// A whole column. @throws scene_file::SceneError  a cell is missing or is no finite number
  std::vector<double> numbers(std::size_t column) const;

  /// An error at a cell. @param message  what is wrong; what is allowed
  scene_file::SceneError error(std::size_t row, std::size_t column,
                               const std::string& message) const;
  /// An error of the heading, or of one of its names.
  scene_file::SceneError heading_error(const std::string& message) const;
  scene_file::SceneError heading_error(std::size_t column, const std::string& message) const;

 private:
  Cell cell(std::size_t row, std::size_t column) const;
  std::string number_of_cells(std::size_t found) const;

  const scene_file::Source& source_;
  FoundTable found_;
};

}  // namespace sonoglide::identify
