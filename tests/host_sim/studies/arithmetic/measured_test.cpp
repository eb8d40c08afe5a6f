/// The recorded errors, instructions and bytes are those of this build, digit by digit.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "host_sim/boards/emulated/board_list.hpp"
#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/studies/arithmetic/comparison.hpp"
#include "tests/common/csv/csv.hpp"

namespace sonoglide::arithmetic::measured_test {
namespace {

constexpr const char* renew =
    "If this is meant, cmake --build --preset release --target write_arithmetic_measured and "
    "commit the change.";

const std::vector<std::string> boards = {SONOGLIDE_ARITHMETIC_BOARDS};

std::vector<csv::Row> rows_of(const csv::Table& table, const std::string& board) {
  std::vector<csv::Row> found;
  for (const csv::Row& row : table.rows()) {
    if (row.text("board") == board) {
      found.push_back(row);
    }
  }
  return found;
}

class MeasuredTest : public testing::TestWithParam<std::string> {};

TEST_P(MeasuredTest, ErrorsInstructionsAndBytesAreThoseOfThisBuild) {
  setenv("XDG_CACHE_HOME", SONOGLIDE_IMAGE_CACHE, 1);
  const auto scene = experiment::read_file(SONOGLIDE_ARITHMETIC_SCENE);
  const csv::Table computed(
      images_csv(compare(scene, {emulated::find_board(GetParam())}, [](double) {})));
  const csv::Table recorded = csv::read_file(SONOGLIDE_ARITHMETIC_MEASURED);
  ASSERT_EQ(recorded.columns(), computed.columns()) << renew;
  const std::vector<csv::Row> rows = rows_of(recorded, GetParam());
  ASSERT_EQ(rows.size(), computed.rows().size()) << renew;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].cells(), computed.rows()[i].cells()) << "recorded and computed. " << renew;
  }
}

INSTANTIATE_TEST_SUITE_P(Boards, MeasuredTest, testing::ValuesIn(boards), [](const auto& board) {
  std::string name = board.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

/// Arithmetics of a board, with the mean instructions of a step.
std::map<std::string, double> instructions(const std::string& board) {
  std::map<std::string, double> found;
  for (const csv::Row& row : rows_of(csv::read_file(SONOGLIDE_ARITHMETIC_MEASURED), board)) {
    found[row.text("arithmetic")] = row.number("instructions_mean");
  }
  return found;
}

TEST(MeasuredTable, HasTheShortestStepsWhereTheDocumentSays) {
  const std::vector<std::pair<std::string, std::string>> shortest = {{"microbit", "q15"},
                                                                     {"mps2-an385", "q31"},
                                                                     {"mps2-an386", "float32"},
                                                                     {"mps2-an500", "float32"},
                                                                     {"riscv32-virt", "q31"}};
  for (const auto& [board, arithmetic] : shortest) {
    const std::map<std::string, double> means = instructions(board);
    for (const auto& [other, mean] : means) {
      EXPECT_LE(means.at(arithmetic), mean) << board << " " << other;
    }
  }
}

}  // namespace
}  // namespace sonoglide::arithmetic::measured_test
