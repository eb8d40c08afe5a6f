#include "tests/boards/budget/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>

#include "host_sim/boards/emulated/board_list.hpp"
#include "host_sim/boards/emulated/image.hpp"
#include "host_sim/process/child_process.hpp"

namespace sonoglide::budget {
namespace {

const Folders folders{SONOGLIDE_IMAGES, SONOGLIDE_CONTROLLERS};
constexpr const char* budget_table = SONOGLIDE_BUDGET_TABLES "/budget.csv";
constexpr const char* feature_table = SONOGLIDE_BUDGET_TABLES "/features.csv";

std::int64_t state_bytes(const ImageBudget& budget) {
  const StateBytes& state = budget.parts.state;
  return static_cast<std::int64_t>(state.controller + state.application + state.board);
}

Row feature_row(const FeatureBoard& board, const std::string& compiler, const Feature& feature,
                const ImageBudget& with, const ImageBudget& without) {
  const auto flash = [](const ImageBudget& budget) {
    return static_cast<std::int64_t>(budget.cost.size.flash_bytes);
  };
  const auto stack = [](const ImageBudget& budget) {
    return static_cast<std::int64_t>(budget.cost.stack.bytes);
  };
  return {{"feature", feature.name},
          {"board", board.board},
          {"arithmetic", board.arithmetic},
          {"compiler", compiler},
          {"flash_bytes", fmt::format("{}", flash(with) - flash(without))},
          {"stack_bytes", fmt::format("{}", stack(with) - stack(without))},
          {"state_bytes", fmt::format("{}", state_bytes(with) - state_bytes(without))},
          {"step_instructions_mean",
           fmt::format("{:.3f}", with.instructions.step.mean - without.instructions.step.mean)},
          {"step_instructions_max",
           fmt::format("{}", std::int64_t{with.instructions.step.max} -
                                 std::int64_t{without.instructions.step.max})}};
}

struct UnitCost {
  std::int64_t flash_bytes;
  std::int64_t stack_bytes;
};

/// Of a unit without a board, which begins with main.
UnitCost unit_cost(const emulated::EmulatedBoard& board, const std::string& unit) {
  const std::string path = fmt::format("{}/{}/{}.elf", SONOGLIDE_UNITS, unit, unit);
  std::ifstream file(path, std::ios::binary);
  const std::string elf{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const std::string disassembly = process::run_tool(
      {emulated::cross_tools(board).prefix + "objdump", "--disassemble", path}, {});
  return {static_cast<std::int64_t>(emulated::image_size(elf).flash_bytes),
          static_cast<std::int64_t>(emulated::stack_bound(disassembly, "main").bytes)};
}

void record(const char* path, const std::vector<Row>& rows) {
  std::ofstream file(path, std::ios::binary);
  file.exceptions(std::ios::failbit | std::ios::badbit);
  file << csv(rows);
}

std::vector<std::string> words_in(const char* text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

bool is_among(std::string_view word, const char* text) {
  const std::vector<std::string> words = words_in(text);
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

std::vector<std::string> example_scenes() {
  return words_in(SONOGLIDE_BUDGET_SCENES);
}

bool has_unit(const std::string& scene) {
  return is_among(scene, SONOGLIDE_BUDGET_UNITS);
}

std::vector<std::string> measured_boards() {
  std::vector<std::string> names;
  for (const emulated::EmulatedBoard& board : emulated::emulated_boards()) {
    if (is_among(board.name, SONOGLIDE_BUDGET_BOARDS)) {
      names.emplace_back(board.name);
    }
  }
  return names;
}

std::vector<Row> measure_scenes(const emulated::EmulatedBoard& board,
                                const std::string& arithmetic) {
  const std::string compiler = compiler_version(board);
  std::vector<Row> rows;
  for (const std::string& scene : example_scenes()) {
    const std::string image = image_name(scene, arithmetic);
    std::optional<UnitBudget> unit;
    if (has_unit(scene)) {
      unit = measure_unit(folders, board, image);
    }
    rows.push_back(
        budget_row(board, arithmetic, scene, compiler, measure(folders, board, image), unit));
  }
  return rows;
}

const std::vector<Feature>& features() {
  static const std::vector<Feature> all = {
      {"shaping", "every_part", "no_shaping", "limits/notch_shaper.hpp", "NotchShaper"},
      {"robust notch", "five_taps", "no_shaping", "limits/notch_shaper.hpp", "NotchShaper"},
      {"feedback", "no_shaping", "no_feedback", "feedback/integral_regulator.hpp",
       "IntegralRegulator"},
      {"adaptive gain", "adaptive_gain", "constant_gain", "feedback/adaptive_regulator.hpp",
       "AdaptiveRegulator"},
      {"calibration", "every_part", "no_calibration", "friction/learnt_friction.hpp",
       "LearntFriction"},
      {"relearning", "relearning", "every_part", "friction/periodic_relearning.hpp",
       "PeriodicRelearning"},
      {"friction tracking", "tracking", "no_calibration", "friction/friction_tracking.hpp",
       "FrictionTracking"},
      {"felt mode", "felt_mode", "no_slew_limit", "vibration/sensorless_vibration.hpp",
       "SensorlessVibration"},
      {"contact lead", "slow_contact", "prompt_contact", "feedback/contact_lead.hpp",
       "ContactLead"},
      {"slew limit", "every_part", "no_slew_limit", "limits/slew_limit.hpp", "control::SlewLimit"},
      {"dahl map", "every_part", "coulomb", "friction/dahl_feedforward.hpp", "DahlFeedforward"},
  };
  return all;
}

ImageBudget measure_feature_scene(const FeatureBoard& board, const std::string& scene) {
  return measure(folders, *emulated::find_board(board.board), image_name(scene, board.arithmetic));
}

std::vector<Row> measure_features(const FeatureBoard& board) {
  const std::string compiler = compiler_version(*emulated::find_board(board.board));
  std::map<std::string, ImageBudget> images;
  const auto image = [&](const std::string& scene) -> const ImageBudget& {
    if (images.count(scene) == 0) {
      images[scene] = measure_feature_scene(board, scene);
    }
    return images[scene];
  };
  std::vector<Row> rows;
  for (const Feature& feature : features()) {
    rows.push_back(
        feature_row(board, compiler, feature, image(feature.with), image(feature.without)));
  }
  return rows;
}

std::vector<Row> measure_services() {
  const emulated::EmulatedBoard& board = *emulated::find_board("mps2-an386");
  const UnitCost alone = unit_cost(board, "unit_m4f");
  const UnitCost unit = unit_cost(board, "unit_m4f_link");
  return {{{"feature", "link"},
           {"board", "Cortex-M4F unit"},
           {"arithmetic", "float32"},
           {"compiler", compiler_version(board)},
           {"flash_bytes", fmt::format("{}", unit.flash_bytes - alone.flash_bytes)},
           {"stack_bytes", fmt::format("{}", unit.stack_bytes - alone.stack_bytes)},
           {"state_bytes", "-"},
           {"step_instructions_mean", "-"},
           {"step_instructions_max", "-"}}};
}

std::vector<Row> recorded_budget() {
  return read_csv(budget_table);
}

std::vector<Row> recorded_features() {
  return read_csv(feature_table);
}

void record_budget(const std::vector<Row>& rows) {
  record(budget_table, rows);
}

void record_features(const std::vector<Row>& rows) {
  record(feature_table, rows);
}

}  // namespace sonoglide::budget
