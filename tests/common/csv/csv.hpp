/// The one reader of CSV in the tests.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace sonoglide::csv {

/// what() names the table, and the line, the column or the cell that is wrong. A test that does not
/// catch it fails with that message.
class CsvError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

using Cells = std::vector<std::string>;

/// What a table is called in messages, and its column names.
struct Heading {
  std::string table;
  Cells columns;
};

/// A line below the heading. Its cells are found by the names of their columns.
class Row {
 public:
  Row(std::shared_ptr<const Heading> heading, std::size_t line, Cells cells);

  const Cells& cells() const { return cells_; }
  /// @throws CsvError  no such column
  const std::string& text(const std::string& column) const;
  /// @throws CsvError  no such column, or its cell is not a number; `nan` is one
  double number(const std::string& column) const;
  /// The same with the digits of a long double.
  long double long_number(const std::string& column) const;

 private:
  CsvError not_a_number(const std::string& column) const;

  std::shared_ptr<const Heading> heading_;
  std::size_t line_;
  Cells cells_;
};

/// A heading, and rows that have a cell for each of its columns. Cells are quoted as of RFC 4180,
/// but no cell has a line break, as the program writes none.
class Table {
 public:
  /// @param name  for messages
  /// @throws CsvError  no heading, a column name twice, a row of another length, a quote that does
  ///         not end its cell
  explicit Table(const std::string& text, const std::string& name = "the table");

  const Cells& columns() const { return heading_->columns; }
  const std::vector<Row>& rows() const { return rows_; }
  /// @throws CsvError  no such column, or one of its cells is not a number
  std::vector<double> numbers(const std::string& column) const;
  /// The only row that has this text in that column.
  /// @throws CsvError  no such column; no such row, or several
  const Row& row_of(const std::string& column, const std::string& text) const;

 private:
  std::shared_ptr<const Heading> heading_;
  std::vector<Row> rows_;
};

/// @throws CsvError  the file cannot be read, or is no table
Table read_file(const std::filesystem::path& path);

}  // namespace sonoglide::csv
