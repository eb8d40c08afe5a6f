/// A table of measurements as instruments and spreadsheets write it: text with named columns.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "host_sim/scene_file/scene_error.hpp"
#include "host_sim/scene_file/source.hpp"
#include "host_sim/studies/identify/cell.hpp"
#include "host_sim/studies/identify/table_search.hpp"

namespace sonoglide::identify {

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
  /// Each a sentence: what of the text is not read.
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
