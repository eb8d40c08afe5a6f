#include "host_sim/studies/robust/task.hpp"

#include <fmt/format.h>

#include <utility>

#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/scene_file/reader.hpp"
#include "host_sim/studies/robust/spread.hpp"

namespace sonoglide::robust {
namespace {

/// @throws scene_file::SceneError  a scene in open loop, or without tolerances
experiment::Experiment read_own(const scene_file::Document& document) {
  experiment::Experiment read = experiment::read(document);
  if (!read.design) {
    throw scene_file::SceneError(document.start(), "controller",
                                 "missing; required: a table [controller], whose loop is to hold "
                                 "inside the tolerances");
  }
  if (read.nominal.controller->texture) {
    throw scene_file::SceneError(document.place_of("controller.target_texture"),
                                 "controller.target_texture",
                                 "robust counts target steps that settle; allowed: "
                                 "target_friction_ratio or target_friction_force_N");
  }
  if (read.nominal.tolerances.empty()) {
    throw scene_file::SceneError(
        document.place_of("tolerance"), "tolerance",
        "no key may vary; required: a table [tolerance] with at least one of them, such as "
        "\"plant.stiffness_N_per_m\" = 0.04");
  }
  return read;
}

/// Varied keys of a document.
std::vector<std::string> true_keys(const scene::Scene& nominal) {
  std::vector<std::string> keys;
  for (const scene::Tolerance& each : nominal.tolerances) {
    keys.push_back("true_values." + each.key);
  }
  return keys;
}

}  // namespace

Task::Task(scene_file::Source source, std::vector<std::string> overrides, const Counts& counts)
    : source_(std::move(source)),
      overrides_(std::move(overrides)),
      counts_(counts),
      stated_(source_, overrides_),
      own_(read_own(stated_)),
      points_(scrambled_sobol(tolerances().size(), counts.samples, counts.seed)) {
  // The echo, so that a plant written as a scene file is the same one.
  document_.emplace(scene_file::Source{source_.file, experiment::text_of(nominal())},
                    std::vector<std::string>{}, true_keys(nominal()));
}

std::vector<std::string> Task::notes() const {
  std::vector<std::string> all = configure::design_notes(design());
  for (const scene::Tolerance& each : tolerances()) {
    if (each.nominal < each.lowest || each.nominal > each.highest) {
      all.push_back(
          fmt::format("The range of {0}, {1:.6g} to {2:.6g}, does not contain the scene's value of "
                      "{3:.6g}, for which the controller is designed.",
                      each.key, each.lowest, each.highest, each.nominal));
    }
  }
  return all;
}

Factors Task::sample(std::size_t index) const {
  Factors factors;
  factors.reserve(tolerances().size());
  for (const scene::Tolerance& each : tolerances()) {
    factors.push_back(quantile(each, points_[index * tolerances().size() + factors.size()]));
  }
  return factors;
}

namespace {

std::vector<scene_file::VariedValue> varied_values(const Factors& factors) {
  return {factors.begin(), factors.end()};
}

}  // namespace

/// A varied value has the place "--vary", line its ordinal: the error is told at its key of [tolerance].
void Task::fail_at(const scene_file::SceneError& error, const Factors& factors) const {
  const std::string key = error.file() == "--vary"
                              ? "tolerance." + tolerances()[error.line() - 1].key
                              : std::string("tolerance");
  throw scene_file::SceneError(
      stated_.place_of(key), key,
      fmt::format("{}: {} (at {})", error.key(), error.message(), describe(factors)));
}

scene::Scene Task::read_plant(const Factors& factors) const {
  // What true values the scene has already are beside those that vary.
  try {
    return scene_file::read_truth(*document_, varied_values(factors), nominal());
  } catch (const scene_file::SceneError& error) {
    fail_at(error, factors);
  }
}

scene::Scene Task::plant(const Factors& factors) const {
  scene::Scene plant = read_plant(factors);
  plant.run.record.clear();
  plant.run.record_interval_s = 0.0;
  return plant;
}

std::string Task::describe(const Factors& factors) const {
  std::string text;
  for (std::size_t i = 0; i < factors.size(); ++i) {
    text += fmt::format("{}{} = {}", i == 0 ? "" : ", ", tolerances()[i].key, factors[i]);
  }
  return text;
}

std::string Task::plant_text(const Factors& factors) const {
  scene::Scene stated = nominal();
  stated.tolerances.clear();
  stated.true_values = read_plant(factors).true_values;
  return experiment::text_of(stated);
}

}  // namespace sonoglide::robust
