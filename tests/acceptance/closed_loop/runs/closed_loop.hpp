/// Closed loops run by the built program, and what its summary says of them.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance {

/// Settings for `--set`, each KEY=VALUE.
using Settings = std::vector<std::string>;

inline const std::vector<std::string> arithmetics = {"float64", "float32", "q31"};

/// One entry of control.steps.
struct Step {
  double target;
  std::optional<double> settling_time_s;
  double overshoot;
  double steady_error;
  double ripple;
  double drive_amplitude_N;
  std::string limit;
};

/// Bounds on what a step may do.
struct Bounds {
  double settling_time_s;
  double steady_error;
  double ripple;
};

/// Runs a scene of the repository, named without its ending, into `out` in the folder.
/// @return its summary; null, and a failed expectation, where the program fails.
nlohmann::json run_scene(const ScratchFolder& folder, const std::string& scene,
                         const Settings& settings = {});

/// The same in a folder of its own.
nlohmann::json summary_of(const std::string& scene, const Settings& settings = {});

/// Runs a scene given as text.
nlohmann::json summary_of_text(const std::string& text, const Settings& settings = {});

/// The text of a scene of the repository.
std::string scene_text(const std::string& scene);

std::vector<Step> steps_of(const nlohmann::json& summary);

/// Expects that no fault occurred and that every step keeps the bounds without a limit being
/// active.
void expect_steps_within(const nlohmann::json& summary, const Bounds& bounds);
void expect_step_within(const Step& step, const Bounds& bounds);
void expect_no_fault(const nlohmann::json& summary);

}  // namespace sonoglide::acceptance
