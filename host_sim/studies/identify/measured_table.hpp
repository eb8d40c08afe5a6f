/// A table of measurements as instruments and spreadsheets write it: text with named columns.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "host_sim/scene_file/scene_error.hpp"
#include "host_sim/scene_file/source.hpp"

namespace sonoglide::identify {

/// The largest file that is read.
inline constexpr std::size_t most_bytes = std::size_t{256} << 20U;

/// The text of a file of measurements, without a byte order mark.
/// @throws scene_file::SceneError  it cannot be read, is empty, larger than most_bytes, in UTF-16,
///         or no text at all
scene_file::Source read_text(const std::filesystem::path& path);

/// A finite number or none; a decimal comma is understood where it is allowed.
bool parse_number(std::string_view cell, bool decimal_comma, double& value);

/// The lines of a text without their ends, CR LF among them. Views of the text.
std::vector<std::string_view> lines_of(std::string_view text);

/// The cells of a line without blanks and quotes around them, each with its column, from 1.
struct Cell {
  std::string_view text;
  std::size_t column;
};
/// @param separator  a blank stands for any number of blanks and tabs
std::vector<Cell> cells_of(std::string_view line, char separator);

/// What stands in the last brackets of a name; empty where nothing does.
std::string unit_in_brackets(const std::string& name);

/// A warning of a text whose last line has no end, and so may be cut; empty for any other.
std::string warning_of_cut(const scene_file::Source& source);

/// Columns of numbers under a heading. The separator is a tab, a semicolon, a comma or blanks,
/// whichever the heading has first in this order. With any but a comma the numbers may have decimal
/// commas, and then none has a decimal point. Lines that begin with `#`, `!` or `%` are comments; the
/// last of them is the heading where no other line is one. What stands above the heading is passed
/// over. A second line of words below it, as of units, is joined to it in brackets. The rows end at a
/// line `END` or at the end of the text.
class MeasuredTable {
 public:
  /// @param source  outlives the table
  /// @throws scene_file::SceneError  no heading, no row, a row of more cells than the heading, or
  ///         decimal points beside decimal commas
  explicit MeasuredTable(const scene_file::Source& source);

  const std::vector<std::string>& names() const { return names_; }
  std::size_t rows() const { return rows_.size(); }
  std::size_t line_of_heading() const { return heading_line_; }

  /// A cell as it stands.
  /// @throws scene_file::SceneError  the row has not as many cells
  std::string_view text(std::size_t row, std::size_t column) const;

  /// A whole column. @throws scene_file::SceneError  a cell is missing or is no finite number
  std::vector<double> numbers(std::size_t column) const;

  /// An error at a cell. @param message  what is wrong; what is allowed
  scene_file::SceneError error(std::size_t row, std::size_t column,
                               const std::string& message) const;
  /// An error of the heading.
  scene_file::SceneError heading_error(const std::string& message) const;

 private:
  struct Row {
    std::string_view line;
    std::size_t number;
  };

  Cell cell(std::size_t row, std::size_t column) const;
  void require_no_surplus() const;
  void require_one_decimal_mark() const;
  void find_heading(const std::vector<std::string_view>& lines, std::size_t& first_row);
  bool take_heading(std::string_view line, std::size_t number);

  const scene_file::Source& source_;
  char separator_ = ',';
  std::size_t heading_line_ = 1;
  std::vector<std::string> names_;
  std::vector<Row> rows_;
};

}  // namespace sonoglide::identify
