/// The columns of a table of measured friction, by name.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "host_sim/scene_file/scene_error.hpp"
#include "host_sim/studies/identify/measured_table.hpp"

namespace sonoglide::identify::friction {

/// A column that a file may have, and what its numbers may be.
struct KnownColumn {
  std::string_view name;
  double least;
  double most;
  std::string_view hint;
};

/// Whether one of the names, a unit in brackets behind it or not, is one of the known columns.
bool are_names_of_readings(const std::vector<std::string>& names);

class ReadingColumns {
 public:
  /// @throws scene_file::SceneError  a column is unknown, there twice, or in another unit
  explicit ReadingColumns(const MeasuredTable& table);

  bool has(std::string_view name) const { return find(name) != nullptr; }

  /// Every number of a column that is there.
  /// @throws scene_file::SceneError  a number is beyond the column's range
  std::vector<double> numbers(std::string_view name) const;

  scene_file::SceneError error(std::size_t row, std::string_view name,
                               const std::string& message) const {
    return table_.error(row, find(name)->index, message);
  }

  /// The one that is there.
  /// @throws scene_file::SceneError  none is there, or more
  std::string_view one_of(std::initializer_list<std::string_view> names) const;

 private:
  struct Column {
    const KnownColumn* known;
    std::size_t index;
  };

  const Column* find(std::string_view name) const;
  /// A name may have its unit behind it, in brackets or on a line of units.
  void take(const std::string& title, std::size_t index);
  scene_file::SceneError unknown(const std::string& name, std::size_t index) const;

  const MeasuredTable& table_;
  std::vector<Column> columns_;
};

}  // namespace sonoglide::identify::friction
