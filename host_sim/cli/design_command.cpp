#include "host_sim/cli/commands.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host_sim/cli/options.hpp"
#include "host_sim/studies/design/report.hpp"
#include "host_sim/studies/design/study.hpp"

namespace sonoglide::cli {
namespace {

struct DesignOptions {
  SceneOptions scene;
  std::vector<double> ratios;
  std::string velocity;  ///< FROM:TO in m/s; empty: the scene's
  StudyOptions study;
};

/// FROM:TO; nothing where it is not of that form or out of order or range.
std::optional<design::SpeedRange> parse_speeds(const std::string& text) {
  char* end = nullptr;
  const double from = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || *end != ':') {
    return std::nullopt;
  }
  const char* second = end + 1;
  const double to = std::strtod(second, &end);
  const bool whole = end != second && *end == '\0';
  const design::SpeedRange speeds{from, to};
  return whole && design::is_allowed(speeds) ? std::optional(speeds) : std::nullopt;
}

std::string check_speeds(const std::string& text) {
  return parse_speeds(text) ? std::string()
                            : fmt::format("\"{}\"; allowed: {}", text, design::allowed_speeds());
}

std::string check_ratio(const std::string& text) {
  char* end = nullptr;
  const double ratio = std::strtod(text.c_str(), &end);
  const bool number = !text.empty() && *end == '\0';
  return number && design::is_allowed(ratio)
             ? std::string()
             : fmt::format("\"{}\"; allowed: a number, {}", text, design::allowed_ratios());
}

/// Throws scene_file::SceneError, loop::ComputationError, process::FileError,
/// process::ProcessError; in each case nothing was written.
void design(const DesignOptions& options) {
  const SceneInput input(options.scene);
  const experiment::Experiment experiment = input.read();
  const design::Task task = input.with_places([&] {
    return design::make_task(experiment, options.ratios, parse_speeds(options.velocity));
  });
  run_study(
      options.study, output_folder(options.study.out, experiment.plant.name, "_design"),
      {"report.html", "design.json", "design.csv", "detuning.csv"},
      [&](const auto& progress) { return design::study(task, progress); }, design::report);
}

}  // namespace

void add_design_command(CLI::App& program) {
  const auto options = std::make_shared<DesignOptions>();
  CLI::App* command = program.add_subcommand(
      "design",
      "Design guidelines for a closed-loop scene: force, vibration and power that its friction "
      "ratios take, what they are sensitive to, what resonance would give, and what is out of reach");
  add_scene_options(*command, options->scene, "its [solver] and initial state play no part");
  command
      ->add_option("--ratio", options->ratios,
                   "A friction ratio in place of the scene's targets; repeatable")
      ->type_name("R")
      ->allow_extra_args(false)
      ->check(check_ratio);
  command
      ->add_option("--velocity", options->velocity,
                   "Slowest and fastest sliding velocity in m/s, in place of the scene's")
      ->type_name("FROM:TO")
      ->check(check_speeds);
  add_study_options(*command, options->study,
                    "report.html, design.json, design.csv and detuning.csv [out/<scene "
                    "name>_design]");
  command->callback([options] { design(*options); });
}

}  // namespace sonoglide::cli
