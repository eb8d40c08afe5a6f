#include "host_sim/studies/sweep/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/runs/run_many.hpp"
#include "host_sim/scene/bound.hpp"

namespace sonoglide::sweep {
namespace {

constexpr std::string_view velocity_key = "sliding.velocity_m_per_s";

/// The key of the scene that an axis sets.
std::string_view scene_key(const Axis& axis) {
  return axis.key == velocity_ratio_key ? velocity_key : std::string_view(axis.key);
}

std::vector<Axis> parse_axes(const std::vector<std::string>& vary) {
  std::vector<Axis> axes;
  axes.reserve(vary.size());
  for (const std::string& text : vary) {
    axes.push_back(parse_axis(text, axes.size() + 1));
  }
  return axes;
}

[[noreturn]] void fail_at_option(std::size_t axis, const std::string& key,
                                 const std::string& message) {
  throw scene_file::SceneError({"--vary", axis + 1, 1}, key, message);
}

}  // namespace

Plan::Plan(scene_file::Source source, std::vector<std::string> overrides,
           std::vector<std::string> vary, std::size_t most)
    : source_(std::move(source)),
      overrides_(std::move(overrides)),
      vary_(std::move(vary)),
      grid_(parse_axes(vary_), most) {
  require_varied_once();
  try {
    document_.emplace(source_, overrides_, varied_keys());
  } catch (const scene_file::SceneError& error) {
    fail_at_point(error, 0);
  }
  const std::vector<Axis>& axes = grid_.axes();
  has_words_ =
      std::any_of(axes.begin(), axes.end(), [](const Axis& axis) { return axis.has_words(); });
  first_ = experiment(0).nominal;
  require_used();
}

std::vector<std::size_t> Plan::wordings() const {
  std::vector<std::size_t> points = {0};
  for (std::size_t axis = 0; axis < grid_.axes().size(); ++axis) {
    if (!grid_.axes()[axis].has_words()) {
      continue;
    }
    std::vector<std::size_t> further;
    for (const std::size_t point : points) {
      for (std::size_t index = 0; index < grid_.axes()[axis].count; ++index) {
        further.push_back(point + index * grid_.stride(axis));
      }
    }
    points = std::move(further);
  }
  return points;
}

/// What one word leaves unused another may need; what none needs has no place in the scene.
void Plan::require_used() const {
  if (!has_words_) {
    return;
  }
  std::optional<scene_file::UnusedKeys> never_used;
  for (const std::size_t point : wordings()) {
    scene_file::UnusedKeys unused;
    try {
      read(point, &unused);
    } catch (const scene_file::SceneError& error) {
      fail_at_point(error, point);
    }
    scene_file::UnusedKeys both;
    if (never_used) {
      std::set_intersection(never_used->begin(), never_used->end(), unused.begin(), unused.end(),
                            std::inserter(both, both.end()));
    }
    never_used = never_used ? std::move(both) : std::move(unused);
  }
  if (!never_used->empty()) {
    const std::string& key = *never_used->begin();
    throw scene_file::SceneError(document_->place_of(key), key,
                                 "not used at any point of the sweep; remove it");
  }
}

experiment::Experiment Plan::experiment(std::size_t point) const {
  try {
    return read(point);
  } catch (const scene_file::SceneError& error) {
    fail_at_point(error, point);
  }
}

void Plan::visit(const PointRange& points, const Visit& visit, long_work::Pace* pace) const {
  constexpr std::size_t points_per_task = 1024;  // milliseconds
  const std::size_t unusable = runs::visit_all(
      points.first, points.end, points_per_task,
      [&](std::size_t point) {
        try {
          visit(point, read(point));
          return true;
        } catch (const scene_file::SceneError&) {
          return false;
        }
      },
      [pace](std::size_t more) {
        if (pace != nullptr) {
          pace->add(more);
        }
      });
  if (unusable < points.end) {
    experiment(unusable);
  }
}

std::string Plan::describe(std::size_t point) const {
  std::string text;
  for (std::size_t axis = 0; axis < grid_.axes().size(); ++axis) {
    text += fmt::format("{}{}={}", axis == 0 ? "" : ", ", grid_.axes()[axis].key,
                        grid_.text(point, axis));
  }
  return text;
}

std::vector<std::string> Plan::varied_keys() const {
  std::vector<std::string> keys;
  for (const Axis& axis : grid_.axes()) {
    keys.emplace_back(scene_key(axis));
  }
  return keys;
}

std::vector<scene_file::VariedValue> Plan::values_of(std::size_t point) const {
  std::vector<scene_file::VariedValue> values;
  values.reserve(grid_.axes().size());
  for (std::size_t i = 0; i < grid_.axes().size(); ++i) {
    const Axis& axis = grid_.axes()[i];
    // The velocity follows from the rest of the scene, once that is read.
    values.push_back(axis.key == velocity_ratio_key ? scene_file::VariedValue(0.0)
                                                    : axis.value(grid_.index(point, i)));
  }
  return values;
}

experiment::Experiment Plan::read(std::size_t point) const {
  scene_file::UnusedKeys passed_over;
  return read(point, has_words_ ? &passed_over : nullptr);
}

experiment::Experiment Plan::read(std::size_t point, scene_file::UnusedKeys* unused) const {
  experiment::Experiment read = experiment::read(*document_, values_of(point), unused);
  for (std::size_t axis = 0; axis < grid_.axes().size(); ++axis) {
    if (grid_.axes()[axis].key == velocity_ratio_key) {
      read.plant.sliding.profile = {{0.0, velocity_m_per_s(read.plant, point, axis)}};
      read.nominal.sliding = read.plant.sliding;
    }
  }
  for (scene::Scene* scene : {&read.plant, &read.nominal}) {
    scene->run.record.clear();
    scene->run.record_interval_s = 0.0;
  }
  return read;
}

double Plan::velocity_m_per_s(const scene::Scene& scene, std::size_t point,
                              std::size_t axis) const {
  constexpr double largest_speed_m_per_s = 1e6;
  const std::string key(velocity_ratio_key);
  const double ratio = grid_.number(point, axis);
  if (std::isnan(ratio)) {
    fail_at_option(axis, key,
                   fmt::format("\"{}\" is no number; allowed: numbers", grid_.text(point, axis)));
  }
  if (scene.controller) {
    fail_at_option(axis, key,
                   "in closed loop the controller sets the vibration; allowed: "
                   "sliding.velocity_m_per_s");
  }
  const double peak_m_per_s =
      scene.drive ? configure::peak_vibration_m_per_s(scene.plant, scene.drive->frequency_Hz,
                                                      scene.drive_force_N())
                  : 0.0;
  if (!(peak_m_per_s > 0.0)) {
    fail_at_option(axis, key,
                   "there is no vibration to relate to; allowed: a scene with a [drive] whose "
                   "force_amplitude_N is above 0");
  }
  const double velocity_m_per_s = ratio * peak_m_per_s;
  if (!(std::abs(velocity_m_per_s) <= largest_speed_m_per_s)) {
    fail_at_option(
        axis, key,
        fmt::format("{} of the peak vibration velocity, {:g} m/s, is too fast; allowed: at "
                    "most {}, either way",
                    ratio, peak_m_per_s, scene::at_most(largest_speed_m_per_s / peak_m_per_s)));
  }
  return velocity_m_per_s;
}

/// One key takes its value from one place.
void Plan::require_varied_once() const {
  const std::vector<Axis>& axes = grid_.axes();
  for (std::size_t i = 0; i < axes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (scene_key(axes[i]) == scene_key(axes[j])) {
        fail_at_option(i, axes[i].key,
                       fmt::format("sets what {} sets; allowed: one of them", axes[j].key));
      }
    }
    for (std::size_t k = 0; k < overrides_.size(); ++k) {
      if (overrides_[k].substr(0, overrides_[k].find('=')) == scene_key(axes[i])) {
        throw scene_file::SceneError(
            {"--set", k + 1, 1}, std::string(scene_key(axes[i])),
            fmt::format("is varied by --vary {}; allowed: one of the two", axes[i].key));
      }
    }
  }
}

void Plan::fail_at_point(const scene_file::SceneError& error, std::size_t point) const {
  if (error.file() != "--vary") {
    try {
      experiment::read(source_, overrides_);
    } catch (const scene_file::SceneError& own) {
      if (std::string_view(own.what()) == error.what()) {
        throw;  // the point has nothing to do with it
      }
    }
  }
  throw scene_file::SceneError({error.file(), error.line(), error.column()}, error.key(),
                               fmt::format("{} (at {})", error.message(), describe(point)));
}

}  // namespace sonoglide::sweep
