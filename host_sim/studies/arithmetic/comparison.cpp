#include "host_sim/studies/arithmetic/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "host_sim/boards/emulated/controller_header.hpp"
#include "host_sim/boards/emulated/run_image.hpp"
#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/scene/names.hpp"

namespace sonoglide::arithmetic {
namespace {

void compare_ratios(const std::vector<double>& ratios, const std::vector<double>& exact,
                    Precision& result) {
  double squares = 0.0;
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    const double difference = std::abs(ratios[i] - exact[i]);
    squares += difference * difference;
    result.largest_difference = std::max(result.largest_difference, difference);
  }
  result.rms_difference = std::sqrt(squares / static_cast<double>(ratios.size()));
}

void judge_steps(const std::vector<report::StepMetrics>& steps, Precision& result) {
  result.steady_error = std::numeric_limits<double>::quiet_NaN();
  result.ripple = std::numeric_limits<double>::quiet_NaN();
  for (const report::StepMetrics& step : steps) {
    if (step.limit == control::Limit::none) {
      result.steady_error = std::fmax(result.steady_error, std::abs(step.steady_error));
      result.ripple = std::fmax(result.ripple, step.ripple);
    }
  }
}

}  // namespace

void require_every_arithmetic(const scene::Scene& scene) {
  if (scene.controller && scene.controller->texture) {
    throw configure::ConfigurationError(
        "controller.target_texture",
        "arithmetics are compared by how target steps settle; allowed: target_friction_ratio or "
        "target_friction_force_N");
  }
  if (scene.controller && scene.controller->vibration) {
    throw configure::ConfigurationError(
        "controller.vibration",
        fmt::format(
            "\"{}\" is not built in q15, and all arithmetics are compared; allowed: a scene "
            "without this key",
            scene::name_of(scene::vibration_controls, *scene.controller->vibration)));
  }
  if (scene.controller && scene.controller->friction == scene::FrictionSource::tracked) {
    throw configure::ConfigurationError(
        "controller.friction",
        "\"tracked\" is not built in q15, and all arithmetics are compared; allowed: \"trusted\", "
        "\"calibrated\"");
  }
}

Precision precision(const Course& course, const Course& exact) {
  Precision result;
  compare_ratios(course.friction_ratios(), exact.friction_ratios(), result);
  judge_steps(course.steps(), result);
  return result;
}

namespace {

/// Targets 0.05, 0.10 … 0.95.
constexpr int last_target = 19;
constexpr double target_spacing = 0.05;

// The real numbers of a design are those of every arithmetic and, where nothing holds the vibration,
// of every target.

configure::Experiment in_arithmetic(configure::Experiment experiment,
                                    scene::Arithmetic arithmetic) {
  experiment.plant.controller.value().arithmetic = arithmetic;
  return experiment;
}

configure::Experiment at_target(configure::Experiment experiment, double target) {
  scene::Controller& controller = experiment.plant.controller.value();
  if (controller.holds_force()) {
    controller.target_friction_force_N = {{0.0, target * experiment.plant.friction.limit_N()}};
  } else {
    controller.target_friction_ratio = {{0.0, target}};
  }
  return experiment;
}

control::Fault first_fault(const loop::RunResult& result) {
  const std::vector<loop::FaultEvent>& faults = result.control->faults;
  return faults.empty() ? control::Fault::none : faults.front().fault;
}

loop::Watch watch(Course& course) {
  return {{&course}, {}, {}};
}

ImageRow image_row(const configure::Experiment& experiment, const emulated::EmulatedBoard& board,
                   const Course& exact) {
  Course course(experiment);
  const loop::RunResult result = emulated::run_image(
      experiment, board, emulated::controller_header(experiment), watch(course));
  emulated::require_same(result);
  return {&board, experiment.plant.controller->arithmetic, precision(course, exact),
          first_fault(result), *result.image};
}

std::vector<TargetRow> rows_at(const configure::Experiment& experiment, double target) {
  const configure::Experiment steady = at_target(experiment, target);
  Course exact(steady);
  loop::run(in_arithmetic(steady, scene::Arithmetic::float64), watch(exact));
  std::vector<TargetRow> rows;
  for (const scene::Arithmetic arithmetic : all_arithmetics) {
    Course course(steady);
    const loop::RunResult result = loop::run(in_arithmetic(steady, arithmetic), watch(course));
    rows.push_back({target, arithmetic, precision(course, exact), course.steps().front().limit,
                    first_fault(result)});
  }
  return rows;
}

}  // namespace

ArithmeticComparison compare(const configure::Experiment& experiment,
                             const std::vector<const emulated::EmulatedBoard*>& boards,
                             const std::function<void(double)>& progress) {
  Course exact(experiment);
  loop::run(in_arithmetic(experiment, scene::Arithmetic::float64), watch(exact));
  ArithmeticComparison comparison;
  const auto steps = static_cast<double>(boards.size() * all_arithmetics.size() + 1);
  double done = 0.0;
  for (const emulated::EmulatedBoard* board : boards) {
    for (const scene::Arithmetic arithmetic : all_arithmetics) {
      progress(done++ / steps);
      if (arithmetic != scene::Arithmetic::float64 || board->computes_double) {
        comparison.images.push_back(
            image_row(in_arithmetic(experiment, arithmetic), *board, exact));
      }
    }
  }
  for (int i = 1; i <= last_target; ++i) {
    for (const TargetRow& row : rows_at(experiment, i * target_spacing)) {
      comparison.targets.push_back(row);
    }
  }
  return comparison;
}

}  // namespace sonoglide::arithmetic
