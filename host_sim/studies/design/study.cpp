#include "host_sim/studies/design/study.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "host_sim/loop/plant/failure.hpp"

namespace sonoglide::design {
namespace {

constexpr int speed_count = 41;

bool is_single(const SpeedRange& speeds) {
  return speeds.slowest_m_per_s == speeds.fastest_m_per_s;
}

/// By equal factors; the task's own speeds are among them, to the bit.
std::vector<double> curve_speeds_m_per_s(const SpeedRange& speeds) {
  const bool single = is_single(speeds);
  const double factor = single ? 100.0 : speeds.fastest_m_per_s / speeds.slowest_m_per_s;
  const int own = single ? speed_count / 2 : 0;
  std::vector<double> all;
  all.reserve(speed_count);
  for (int i = 0; i < speed_count; ++i) {
    all.push_back(speeds.slowest_m_per_s *
                  std::pow(factor, static_cast<double>(i - own) / (speed_count - 1)));
  }
  if (!single) {
    all.back() = speeds.fastest_m_per_s;
  }
  return all;
}

bool has_motion(const steady::Requirement& requirement) {
  return requirement.limit == steady::Obstacle::none ||
         requirement.limit == steady::Obstacle::actuator ||
         requirement.limit == steady::Obstacle::velocity_at_rail;
}

steady::Requirement requirement_at(const Task& task, double sliding_m_per_s, double ratio) {
  steady::Requirement found = steady::require_ratio(task.scene, sliding_m_per_s, ratio);
  if (found.limit == steady::Obstacle::none && sliding_m_per_s >= task.full_scale_m_per_s) {
    found.limit = steady::Obstacle::velocity_at_rail;
    found.reachable_ratio = 1.0;
  }
  return found;
}

RatioRequirements ratio_curve(const Task& task, double ratio,
                              const std::vector<double>& speeds_m_per_s) {
  RatioRequirements curve{
      ratio, std::vector<steady::Requirement>(speeds_m_per_s.size()),
      std::min(steady::fastest_sliding_m_per_s(task.scene, ratio), task.full_scale_m_per_s)};
  tbb::parallel_for(std::size_t{0}, speeds_m_per_s.size(), [&](std::size_t i) {
    curve.requirements[i] = requirement_at(task, speeds_m_per_s[i], ratio);
  });
  return curve;
}

DesignPoint design_point(const Task& task, const steady::Requirement& requirement) {
  DesignPoint point{requirement, {}};
  if (has_motion(requirement)) {
    point.sensitivities = sensitivities(steady::steady_scene(
        task.scene, requirement.sliding_m_per_s, requirement.motion.drive_force_N));
  }
  return point;
}

/// Of every curve the requirement at a speed that it was computed for.
std::vector<steady::Requirement> requirements_at(const std::vector<RatioRequirements>& curves,
                                                 double sliding_m_per_s) {
  std::vector<steady::Requirement> all;
  all.reserve(curves.size());
  for (const RatioRequirements& curve : curves) {
    all.push_back(*std::find_if(
        curve.requirements.begin(), curve.requirements.end(),
        [&](const steady::Requirement& each) { return each.sliding_m_per_s == sliding_m_per_s; }));
  }
  return all;
}

std::vector<DesignPoint> design_points(const Task& task,
                                       const std::vector<RatioRequirements>& curves) {
  std::vector<steady::Requirement> wanted = requirements_at(curves, task.speeds.slowest_m_per_s);
  if (!is_single(task.speeds)) {
    const auto fastest = requirements_at(curves, task.speeds.fastest_m_per_s);
    wanted.insert(wanted.end(), fastest.begin(), fastest.end());
  }
  std::vector<DesignPoint> points(wanted.size());
  tbb::parallel_for(std::size_t{0}, wanted.size(),
                    [&](std::size_t i) { points[i] = design_point(task, wanted[i]); });
  return points;
}

std::vector<Detuning> detunings(const Task& task, const std::vector<RatioRequirements>& curves) {
  std::vector<steady::Requirement> wanted = requirements_at(curves, task.speeds.fastest_m_per_s);
  wanted.erase(std::remove_if(wanted.begin(), wanted.end(),
                              [](const steady::Requirement& each) { return !has_motion(each); }),
               wanted.end());
  std::vector<Detuning> all(wanted.size());
  tbb::parallel_for(std::size_t{0}, wanted.size(),
                    [&](std::size_t i) { all[i] = detune(task.scene, wanted[i]); });
  return all;
}

/// A plant that no force gives an orbit is a failure, with the first reason for it.
void require_an_orbit(const std::vector<DesignPoint>& points) {
  const bool none = std::all_of(points.begin(), points.end(), [](const DesignPoint& point) {
    return !point.requirement.any_orbit;
  });
  if (none) {
    throw loop::ComputationError(points.front().requirement.reason);
  }
}

std::optional<NaturalModeStudy> natural_mode(const DesignStudy& study) {
  const double fastest_m_per_s = study.task.speeds.fastest_m_per_s;
  std::vector<double> reached;
  for (const DesignPoint& point : study.points) {
    const steady::Requirement& each = point.requirement;
    if (each.sliding_m_per_s == fastest_m_per_s && each.limit == steady::Obstacle::none) {
      reached.push_back(each.ratio);
    }
  }
  return reached.empty() ? std::nullopt
                         : natural_mode_study(study.task.stated, reached, fastest_m_per_s);
}

SelfExcitation self_excitation_at(const scene::Scene& scene, double sliding_m_per_s) {
  const double most_N = scene.max_drive_force_N();
  return {sliding_m_per_s, steady::steady_sliding(scene, sliding_m_per_s, 0.0).fate(),
          steady::drive_windows(scene, sliding_m_per_s, most_N),
          steady::averaged_drive_windows(scene, sliding_m_per_s, most_N)};
}

std::vector<SelfExcitation> self_excitation(const Task& task) {
  if (!steady::friction_falls(task.scene.friction)) {
    return {};
  }
  std::vector<SelfExcitation> all = {self_excitation_at(task.scene, task.speeds.slowest_m_per_s)};
  if (!is_single(task.speeds)) {
    all.push_back(self_excitation_at(task.scene, task.speeds.fastest_m_per_s));
  }
  return all;
}

}  // namespace

std::vector<DesignPoint> moving_points(const DesignStudy& study) {
  std::vector<DesignPoint> points;
  for (const DesignPoint& point : study.points) {
    if (has_motion(point.requirement)) {
      points.push_back(point);
    }
  }
  return points;
}

const steady::Requirement* most_electrical(const DesignStudy& study) {
  const steady::Requirement* most = nullptr;
  for (const DesignPoint& point : study.points) {
    const auto& electrical = point.requirement.motion.electrical;
    if (electrical && (most == nullptr || electrical->apparent_power_VA >
                                              most->motion.electrical->apparent_power_VA)) {
      most = &point.requirement;
    }
  }
  return most;
}

DesignStudy study(const Task& task, const Progress& progress) {
  const std::vector<double> speeds_m_per_s = curve_speeds_m_per_s(task.speeds);
  DesignStudy study{task, tuning(task.scene), {}, {}, {}, {}, {}, {}};
  for (const double ratio : task.ratios) {
    study.curves.push_back(ratio_curve(task, ratio, speeds_m_per_s));
    progress(0.5 * static_cast<double>(study.curves.size()) /
             static_cast<double>(task.ratios.size()));
  }
  study.points = design_points(task, study.curves);
  require_an_orbit(study.points);
  study.detunings = detunings(task, study.curves);
  if (const steady::Requirement* most = most_electrical(study)) {
    study.resonant_spring = on_resonance(task.scene, *most);
  }
  study.natural_mode = natural_mode(study);
  study.self_excitation = self_excitation(task);
  progress(1.0);
  return study;
}

}  // namespace sonoglide::design
