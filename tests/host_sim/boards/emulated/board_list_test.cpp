// The list of boards against what the boards are built with: presets, toolchain files, folders.
#include "host_sim/boards/emulated/board_list.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "host_sim/boards/emulated/unit_image.hpp"
#include "host_sim/process/regular_expression.hpp"

namespace sonoglide::emulated::board_list_test {
namespace {

const std::string source_folder = SONOGLIDE_SOURCE_DIR;

/// Toolchain file of each configure preset that has one, by the preset's name.
nlohmann::json toolchains() {
  std::ifstream file(source_folder + "/CMakePresets.json");
  nlohmann::json found = nlohmann::json::object();
  const nlohmann::json presets = nlohmann::json::parse(file);
  for (const auto& preset : presets.at("configurePresets")) {
    if (preset.contains("toolchainFile")) {
      found[preset.at("name").get<std::string>()] = preset.at("toolchainFile");
    }
  }
  return found;
}

TEST(BoardList, EachBoardHasItsPresetWithItsToolchain) {
  const nlohmann::json presets = toolchains();
  for (const ImageBoard& board : unit_boards()) {
    const std::string file = "tools/toolchains/" + std::string(board.toolchain) + ".cmake";
    ASSERT_TRUE(presets.contains(std::string(board.name))) << board.name;
    EXPECT_EQ(presets.at(std::string(board.name)), file);
    EXPECT_TRUE(std::filesystem::exists(source_folder + "/" + file)) << file;
  }
}

TEST(BoardList, EachBoardHasItsLineAmongTheBoardsAndEachLineItsFolder) {
  std::ifstream file(source_folder + "/tools/cmake/boards.cmake");
  const std::string lines{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  for (const EmulatedBoard& board : emulated_boards()) {
    const process::RegularExpression name("[( ]" + std::string(board.name) + "[ )\n]");
    EXPECT_FALSE(name.search(lines).empty()) << board.name;
  }
  const process::RegularExpression folder("FOLDER (hal/[a-z0-9_]+)");
  for (const process::Match& each : folder.search_all(lines)) {
    EXPECT_TRUE(std::filesystem::is_directory(source_folder + "/" + each[1])) << each[1];
  }
}

TEST(BoardList, APageHasTheCarriersOfItsBoard) {
  for (const auto& [board, folder] : std::vector<std::pair<const char*, const char*>>{
           {"pico", "pico"}, {"pico2", "pico/rp2350"}, {"nucleo-g474re", "nucleo_g474re"}}) {
    std::ifstream file(source_folder + "/hal/" + folder + "/README.md");
    const std::string page{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    EXPECT_NE(page.find(find_unit_board(board)->carriers), std::string::npos) << board;
  }
}

TEST(BoardList, FindsABoardByItsNameAlone) {
  std::set<std::string_view> names;
  for (const EmulatedBoard& board : emulated_boards()) {
    EXPECT_EQ(find_board(board.name), &board);
    EXPECT_TRUE(names.insert(board.name).second) << board.name;
  }
  EXPECT_EQ(find_board("mps2"), nullptr);
  EXPECT_EQ(find_board(""), nullptr);
}

TEST(BoardList, AUnitIsBuiltForEachBoardThatRunsScenes) {
  for (const auto* boards : {&emulated_boards(), &carrier_boards()}) {
    for (const EmulatedBoard& board : *boards) {
      const UnitBoard* const found = find_unit_board(board.name);
      ASSERT_NE(found, nullptr) << board.name;
      EXPECT_EQ(found->core, board.core);
      EXPECT_EQ(found->toolchain, board.toolchain);
      EXPECT_EQ(found->computes_double, board.computes_double);
    }
  }
  EXPECT_EQ(find_unit_board("template"), nullptr);
}

TEST(BoardList, CommandEndsInTheImage) {
  for (const EmulatedBoard& board : emulated_boards()) {
    const std::vector<std::string> command = emulator_command(board, "a folder/image.elf");
    EXPECT_EQ(command.front(), board.emulator);
    EXPECT_EQ(command[command.size() - 2], "-kernel");
    EXPECT_EQ(command.back(), "a folder/image.elf");
  }
}

}  // namespace
}  // namespace sonoglide::emulated::board_list_test
