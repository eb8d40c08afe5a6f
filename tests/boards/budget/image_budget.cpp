#include "tests/boards/budget/image_budget.hpp"

#include <fmt/format.h>

#include "host_sim/boards/emulated/board_list.hpp"
#include "host_sim/boards/emulated/run_image.hpp"
#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/loop/run_result.hpp"
#include "host_sim/process/child_process.hpp"
#include "tests/common/csv/csv.hpp"

namespace sonoglide::budget {
namespace {

std::string joined(const Row& row, std::string Figure::*member) {
  std::string line;
  for (const Figure& figure : row) {
    line += (line.empty() ? "" : ",") + figure.*member;
  }
  return line + "\n";
}

std::filesystem::path path_of(const Folders& folders, const emulated::EmulatedBoard& board,
                              const std::string& image) {
  return folders.images / std::string(board.name) / "bin" / (image + ".elf");
}

/// Over a scene, in lockstep.
loop::ImageInstructions instructions_of(const Folders& folders,
                                        const emulated::EmulatedBoard& board,
                                        const std::string& scene,
                                        const std::filesystem::path& path) {
  const experiment::Experiment experiment =
      experiment::read_file(folders.controllers / scene / "scene.toml");
  const loop::RunResult result = emulated::run_emulator(experiment, board, path, {});
  emulated::require_same(result);
  return result.image->instructions.value();
}

std::string bound_of(const emulated::StackBound& stack) {
  return stack.unbounded_by.empty() ? fmt::format("{}", stack.bytes) : stack.unbounded_by;
}

/// "-" where no unit is measured.
Row unit_figures(const std::optional<UnitBudget>& unit) {
  const auto figure = [&](const char* column, auto value) {
    return Figure{column, unit ? fmt::format("{}", value(*unit)) : "-"};
  };
  return {
      figure("unit_control_instructions_median", [](auto& each) { return each.control.median; }),
      figure("unit_control_instructions_max", [](auto& each) { return each.control.max; }),
      figure("unit_flash_bytes", [](auto& each) { return each.cost.size.flash_bytes; }),
      figure("unit_static_ram_bytes", [](auto& each) { return each.cost.size.ram_bytes; }),
      figure("unit_stack_bytes_bound", [](auto& each) { return bound_of(each.cost.stack); })};
}

}  // namespace

ImageBudget measure(const Folders& folders, const emulated::EmulatedBoard& board,
                    const std::string& image) {
  const std::filesystem::path path = path_of(folders, board, image);
  const emulated::ImageCost cost = emulated::measure_image(path, board);
  return {cost, image_parts(board, path, cost.size.flash_bytes),
          instructions_of(folders, board, image, path)};
}

UnitBudget measure_unit(const Folders& folders, const emulated::EmulatedBoard& board,
                        const std::string& image) {
  return {instructions_of(folders, board, image, path_of(folders, board, image + "_counted")).step,
          emulated::measure_image(path_of(folders, board, image + "_timed"), board)};
}

Row budget_row(const emulated::EmulatedBoard& board, const std::string& arithmetic,
               const std::string& scene, const std::string& compiler, const ImageBudget& budget,
               const std::optional<UnitBudget>& unit) {
  const auto& [step, answer] = budget.instructions;
  const Parts& flash = budget.parts.flash;
  const StateBytes& state = budget.parts.state;
  const auto text = [](auto value) { return fmt::format("{}", value); };
  Row row = {{"board", std::string(board.name)},
             {"arithmetic", arithmetic},
             {"scene", scene},
             {"compiler", compiler},
             {"step_instructions_min", text(step.min)},
             {"step_instructions_mean", fmt::format("{:.3f}", step.mean)},
             {"step_instructions_max", text(step.max)},
             {"answer_instructions_mean", fmt::format("{:.3f}", answer.mean)},
             {"flash_bytes", text(budget.cost.size.flash_bytes)},
             {"flash_controller", text(flash.controller)},
             {"flash_application", text(flash.application)},
             {"flash_board", text(flash.board)},
             {"flash_library", text(flash.library)},
             {"static_ram_bytes", text(budget.cost.size.ram_bytes)},
             {"state_controller", text(state.controller)},
             {"state_application", text(state.application)},
             {"state_board", text(state.board)},
             {"stack_bytes_bound", bound_of(budget.cost.stack)}};
  const Row more = unit_figures(unit);
  row.insert(row.end(), more.begin(), more.end());
  return row;
}

std::string compiler_version(const emulated::EmulatedBoard& board) {
  std::string version =
      process::run_tool({emulated::cross_tools(board).prefix + "g++", "-dumpfullversion"}, {});
  version.erase(version.find_last_not_of('\n') + 1);
  return version;
}

std::string image_name(const std::string& scene, const std::string& arithmetic) {
  return arithmetic == "float32" ? scene : scene + "_" + arithmetic;
}

std::string csv(const std::vector<Row>& rows) {
  std::string text = rows.empty() ? "" : joined(rows.front(), &Figure::column);
  for (const Row& row : rows) {
    text += joined(row, &Figure::value);
  }
  return text;
}

std::vector<Row> read_csv(const std::filesystem::path& path) {
  const csv::Table table = csv::read_file(path);
  std::vector<Row> rows;
  for (const csv::Row& line : table.rows()) {
    Row& row = rows.emplace_back();
    for (const std::string& column : table.columns()) {
      row.push_back({column, line.text(column)});
    }
  }
  return rows;
}

}  // namespace sonoglide::budget
