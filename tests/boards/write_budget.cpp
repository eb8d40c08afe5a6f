// Measures every image again and writes the tables that the tests hold them to.
#include <exception>
#include <iostream>
#include <vector>

#include "host_sim/boards/emulated/board_list.hpp"
#include "tests/boards/budget/table.hpp"

namespace {

namespace budget = sonoglide::budget;

void append(std::vector<budget::Row>& rows, const std::vector<budget::Row>& more) {
  rows.insert(rows.end(), more.begin(), more.end());
}

void write_tables() {
  std::vector<budget::Row> scenes;
  for (const auto& board : budget::measured_boards()) {
    for (const auto& arithmetic : budget::arithmetics) {
      append(scenes, budget::measure_scenes(*sonoglide::emulated::find_board(board), arithmetic));
    }
  }
  std::vector<budget::Row> features;
  for (const auto& board : budget::feature_boards) {
    append(features, budget::measure_features(board));
  }
  append(features, budget::measure_services());
  budget::record_budget(scenes);
  budget::record_features(features);
}

}  // namespace

int main() {
  try {
    write_tables();
    return 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
