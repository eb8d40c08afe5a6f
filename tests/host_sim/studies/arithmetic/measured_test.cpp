/// The recorded errors, instructions and bytes are those of this build, digit by digit.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "host_sim/emulated/board_list.hpp"
#include "host_sim/scene_file/reader.hpp"
#include "host_sim/studies/arithmetic/comparison.hpp"
#include "host_sim/studies/arithmetic/report.hpp"

namespace sonoglide::arithmetic {
namespace {

constexpr const char* renew =
    "If this is meant, cmake --build --preset release --target write_arithmetic_measured and "
    "commit the change.";

const std::vector<std::string> boards = {SONOGLIDE_ARITHMETIC_BOARDS};

/// The heading, and the lines of a board.
std::vector<std::string> lines_of(std::istream& table, const std::string& board) {
  std::vector<std::string> found;
  for (std::string line; std::getline(table, line);) {
    if (found.empty() || line.rfind(board + ",", 0) == 0) {
      found.push_back(line);
    }
  }
  return found;
}

std::vector<std::string> recorded_lines(const std::string& board) {
  std::ifstream file(SONOGLIDE_ARITHMETIC_MEASURED);
  return lines_of(file, board);
}

class MeasuredTest : public testing::TestWithParam<std::string> {};

TEST_P(MeasuredTest, ErrorsInstructionsAndBytesAreThoseOfThisBuild) {
  setenv("XDG_CACHE_HOME", SONOGLIDE_IMAGE_CACHE, 1);
  const scene::Scene scene = scene_file::read_file(SONOGLIDE_ARITHMETIC_SCENE);
  std::istringstream table(images_csv(compare(
      scene, {emulated::find_board(GetParam())}, [] {}, [](double) {})));
  const std::vector<std::string> computed = lines_of(table, GetParam());
  const std::vector<std::string> recorded = recorded_lines(GetParam());
  ASSERT_EQ(recorded.size(), computed.size()) << renew;
  for (std::size_t i = 0; i < computed.size(); ++i) {
    EXPECT_EQ(recorded[i], computed[i]) << "recorded and computed. " << renew;
  }
}

INSTANTIATE_TEST_SUITE_P(Boards, MeasuredTest, testing::ValuesIn(boards), [](const auto& board) {
  std::string name = board.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

/// Arithmetics of a board, with the mean instructions of a step.
std::map<std::string, double> instructions(const std::string& board) {
  constexpr std::size_t arithmetic = 2;
  constexpr std::size_t mean = 9;
  std::vector<std::string> lines = recorded_lines(board);
  lines.erase(lines.begin());
  std::map<std::string, double> found;
  for (const std::string& line : lines) {
    std::vector<std::string> cells;
    std::istringstream text(line);
    for (std::string cell; std::getline(text, cell, ',');) {
      cells.push_back(cell);
    }
    found[cells.at(arithmetic)] = std::stod(cells.at(mean));
  }
  return found;
}

TEST(MeasuredTable, HasTheShortestStepsWhereTheDocumentSays) {
  const std::vector<std::pair<std::string, std::string>> shortest = {{"microbit", "q15"},
                                                                     {"mps2-an385", "q31"},
                                                                     {"mps2-an386", "float32"},
                                                                     {"mps2-an500", "float32"},
                                                                     {"riscv32-virt", "q15"}};
  for (const auto& [board, arithmetic] : shortest) {
    const std::map<std::string, double> means = instructions(board);
    for (const auto& [other, mean] : means) {
      EXPECT_LE(means.at(arithmetic), mean) << board << " " << other;
    }
  }
}

}  // namespace
}  // namespace sonoglide::arithmetic
