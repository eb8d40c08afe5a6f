#include "tests/boards/budget/image_budget.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/emulated/board_list.hpp"
#include "host_sim/emulated/run_image.hpp"
#include "host_sim/loop/run.hpp"
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

}  // namespace

ImageBudget measure(const Folders& folders, const emulated::EmulatedBoard& board,
                    const std::string& image) {
  const std::filesystem::path path =
      folders.images / std::string(board.name) / "bin" / (image + ".elf");
  const experiment::Experiment experiment =
      experiment::read_file(folders.controllers / image / "scene.toml");
  const emulated::ImageCost cost = emulated::measure_image(path, board);
  const loop::RunResult result = emulated::run_emulator(experiment, board, path, {});
  if (!result.image->workstation->same) {
    throw std::runtime_error(path.string() + ": its commands are not the workstation's");
  }
  return {cost, image_parts(board, path, cost.size.flash_bytes),
          result.image->instructions.value()};
}

Row budget_row(const emulated::EmulatedBoard& board, const std::string& arithmetic,
               const std::string& scene, const std::string& compiler, const ImageBudget& budget) {
  const auto& [step, answer] = budget.instructions;
  const Parts& flash = budget.parts.flash;
  const StateBytes& state = budget.parts.state;
  const auto text = [](auto value) { return fmt::format("{}", value); };
  return {{"board", std::string(board.name)},
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
          {"stack_bytes_bound", budget.cost.stack.unbounded_by.empty()
                                    ? text(budget.cost.stack.bytes)
                                    : budget.cost.stack.unbounded_by}};
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
