// What every image costs, held to the repository's tables exactly: dearer and cheaper both fail.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <vector>

#include "host_sim/boards/emulated/board_list.hpp"
#include "tests/boards/budget/table.hpp"

namespace sonoglide::budget::budget_test {
namespace {

constexpr const char* renew =
    "If this is meant, cmake --build --preset release --target write_budget and commit the change.";

std::string value(const Row& row, const std::string& column) {
  const auto found = std::find_if(row.begin(), row.end(),
                                  [&](const Figure& figure) { return figure.column == column; });
  return found == row.end() ? "" : found->value;
}

/// The recorded rows that have what a row has in some columns.
std::vector<Row> alike(const std::vector<Row>& recorded, const Row& row,
                       const std::vector<std::string>& columns) {
  std::vector<Row> found;
  for (const Row& each : recorded) {
    const bool same = std::all_of(columns.begin(), columns.end(), [&](const std::string& column) {
      return value(each, column) == value(row, column);
    });
    if (same) {
      found.push_back(each);
    }
  }
  return found;
}

void expect_recorded(const Row& measured, const std::vector<Row>& recorded,
                     const std::vector<std::string>& key) {
  std::string name;
  for (const std::string& column : key) {
    name += value(measured, column) + " ";
  }
  const std::vector<Row> rows = alike(recorded, measured, key);
  ASSERT_EQ(rows.size(), 1U) << name << "has no row of its own. " << renew;
  ASSERT_EQ(value(measured, "compiler"), value(rows[0], "compiler"))
      << name << "was recorded with another compiler: its figures say nothing about this one's "
      << "images. tools/setup test installs the recorded one.";
  for (const Figure& figure : measured) {
    EXPECT_EQ(figure.value, value(rows[0], figure.column))
        << name << figure.column << ", measured and recorded. " << renew;
  }
}

std::string name_of(std::string text) {
  std::replace(text.begin(), text.end(), '-', '_');
  return text;
}

class BudgetTest : public testing::TestWithParam<std::tuple<std::string, std::string>> {};

TEST_P(BudgetTest, IsTheRecordedOne) {
  const auto& [board, arithmetic] = GetParam();
  const std::vector<Row> recorded = recorded_budget();
  for (const Row& row : measure_scenes(*emulated::find_board(board), arithmetic)) {
    expect_recorded(row, recorded, {"board", "arithmetic", "scene"});
  }
}

INSTANTIATE_TEST_SUITE_P(Boards, BudgetTest,
                         testing::Combine(testing::ValuesIn(measured_boards()),
                                          testing::ValuesIn(arithmetics)),
                         [](const auto& parameter) {
                           return name_of(std::get<0>(parameter.param)) + "_" +
                                  std::get<1>(parameter.param);
                         });

TEST(BudgetTableTest, HasARowForEachBoardArithmeticAndScene) {
  EXPECT_EQ(recorded_budget().size(),
            measured_boards().size() * arithmetics.size() * example_scenes().size());
}

TEST(BudgetTableTest, CountsEachByteOfFlashOnce) {
  for (const Row& row : recorded_budget()) {
    const auto bytes = [&](const char* column) { return std::stoul(value(row, column)); };
    EXPECT_EQ(bytes("flash_bytes"), bytes("flash_controller") + bytes("flash_application") +
                                        bytes("flash_board") + bytes("flash_library"))
        << value(row, "board") << " " << value(row, "arithmetic") << " " << value(row, "scene");
  }
}

/// What is promised of the Table 1 scene, whatever the tables hold.
struct Promise {
  std::string board;
  std::string arithmetic;
  std::string column;
  double most;
};

TEST(BudgetTableTest, KeepsThePromisesOfTable1) {
  const std::vector<Promise> promises = {
      {"mps2-an386", "float32", "step_instructions_max", 480},
      {"mps2-an385", "q31", "step_instructions_max", 600},
      {"microbit", "q31", "step_instructions_max", 1300},
      {"mps2-an386", "float32", "stack_bytes_bound", 768},
      {"mps2-an386", "q31", "stack_bytes_bound", 768},
      {"mps2-an386", "float32", "flash_bytes", 12288},
      {"mps2-an385", "q31", "flash_bytes", 12288},
      {"microbit", "float32", "flash_bytes", 14336},
      {"microbit", "q31", "flash_bytes", 12288},
      {"riscv32-virt", "float32", "flash_bytes", 14336},
      {"riscv32-virt", "q31", "flash_bytes", 14336},
  };
  for (const Promise& promise : promises) {
    const Row scene = {
        {"board", promise.board}, {"arithmetic", promise.arithmetic}, {"scene", "target_step"}};
    const std::vector<Row> rows = alike(recorded_budget(), scene, {"board", "arithmetic", "scene"});
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_LE(std::stod(value(rows[0], promise.column)), promise.most)
        << promise.board << " " << promise.arithmetic << " " << promise.column;
  }
}

TEST(BudgetTableTest, KeepsStateAndStaticRamBelowOneKibibyte) {
  for (const Row& row : recorded_budget()) {
    double bytes = 0.0;
    for (const char* column :
         {"static_ram_bytes", "state_controller", "state_application", "state_board"}) {
      bytes += std::stod(value(row, column));
    }
    EXPECT_LE(bytes, 1024.0) << value(row, "board") << " " << value(row, "scene");
  }
}

class FeatureTest : public testing::TestWithParam<FeatureBoard> {};

TEST_P(FeatureTest, CostsWhatIsRecorded) {
  const std::vector<Row> recorded = recorded_features();
  for (const Row& row : measure_features(GetParam())) {
    expect_recorded(row, recorded, {"feature", "board", "arithmetic"});
  }
}

TEST(ServiceTest, CostsWhatIsRecorded) {
  const std::vector<Row> recorded = recorded_features();
  for (const Row& row : measure_services()) {
    expect_recorded(row, recorded, {"feature", "board", "arithmetic"});
  }
}

/// Of the bytes of an image: those of a part of the controller, and whether a name tells of it.
struct Trace {
  std::uint64_t bytes;
  bool named;
};

Trace trace_of(const Feature& feature, const ImageParts& parts) {
  const auto found = parts.files.find("firmware/control/" + feature.file);
  return {found == parts.files.end() ? 0 : found->second,
          parts.names.find(feature.type) != std::string::npos};
}

TEST_P(FeatureTest, LeavesNothingInAnImageWithoutIt) {
  for (const Feature& feature : features()) {
    const Trace with = trace_of(feature, measure_feature_scene(GetParam(), feature.with).parts);
    EXPECT_GT(with.bytes, 0U) << feature.name;
    EXPECT_TRUE(with.named) << feature.name;
    const Trace without =
        trace_of(feature, measure_feature_scene(GetParam(), feature.without).parts);
    EXPECT_EQ(without.bytes, 0U) << feature.name;
    EXPECT_FALSE(without.named) << feature.name;
  }
}

TEST_P(FeatureTest, LeavesLinkAndStoreToUnitsThatHaveThem) {
  const ImageParts parts = measure_feature_scene(GetParam(), "every_part").parts;
  for (const auto& [file, bytes] : parts.files) {
    for (const char* service :
         {"encoding/", "app/link", "app/store/", "app/unit", "app/host_ramp"}) {
      EXPECT_EQ(file.find(service), std::string::npos) << file;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Boards, FeatureTest, testing::ValuesIn(feature_boards),
                         [](const auto& parameter) { return name_of(parameter.param.board); });

}  // namespace
}  // namespace sonoglide::budget::budget_test
