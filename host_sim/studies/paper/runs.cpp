#include "host_sim/studies/paper/runs.hpp"

#include <tbb/parallel_for.h>

#include <cmath>
#include <cstddef>
#include <limits>

#include "host_sim/loop/run.hpp"
#include "host_sim/studies/paper/table_1.hpp"

namespace sonoglide::paper {
namespace {

template <class Of>
std::vector<double> column(const loop::Recording& recording, Of of) {
  std::vector<double> values;
  values.reserve(recording.state.size());
  for (const loop::PlantState& state : recording.state) {
    values.push_back(of(state));
  }
  return values;
}

}  // namespace

loop::Recording record(const scene::Scene& scene, double from_s, double interval_s) {
  loop::Recording recording;
  loop::Watch watch;
  watch.samples.push_back({{from_s, scene.run.duration_s, interval_s}, &recording});
  loop::run(scene, watch);
  return recording;
}

std::vector<double> displacements_m(const loop::Recording& recording) {
  return column(recording, [](const loop::PlantState& state) { return state.displacement_m; });
}

std::vector<double> velocities_m_per_s(const loop::Recording& recording) {
  return column(recording, [](const loop::PlantState& state) { return state.velocity_m_per_s; });
}

std::vector<double> friction_forces_N(const loop::Recording& recording) {
  return column(recording, [](const loop::PlantState& state) { return state.friction_force_N; });
}

std::vector<double> dissipated_powers_W(const loop::Recording& recording) {
  std::vector<double> powers;
  powers.reserve(recording.state.size());
  for (std::size_t i = 0; i < recording.state.size(); ++i) {
    powers.push_back(recording.state[i].friction_force_N *
                     (recording.sliding_velocity_m_per_s[i] + recording.state[i].velocity_m_per_s));
  }
  return powers;
}

namespace {

constexpr double ratio_step = 0.05;
constexpr int ratio_count = 24;

loop::PowerRatios power_ratios(const scene::Scene& scene) {
  try {
    return loop::power_ratios(scene, loop::run(scene).whole);
  } catch (const loop::ComputationError&) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    return {none, none, none, none, none, none, none, none};
  }
}

}  // namespace

const std::vector<double>& velocity_ratios() {
  static const std::vector<double> ratios = [] {
    std::vector<double> values;
    values.reserve(ratio_count);
    for (int i = 1; i <= ratio_count; ++i) {
      values.push_back(i * ratio_step);
    }
    return values;
  }();
  return ratios;
}

std::size_t index_of(double velocity_ratio) {
  return static_cast<std::size_t>(std::lround(velocity_ratio / ratio_step)) - 1;
}

SimulatedRatios ratio_curve(const scene::Scene& scene, const std::vector<double>& sliding_m_per_s) {
  const std::size_t count = sliding_m_per_s.size();
  SimulatedRatios curve{std::vector<double>(count), std::vector<double>(count),
                        std::vector<double>(count), std::vector<double>(count)};
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    scene::Scene point = scene;
    point.sliding.profile = {{0.0, sliding_m_per_s[i]}};
    const loop::PowerRatios from_rest = power_ratios(point);
    const loop::PowerRatios on_orbit = power_ratios(steady(point));
    curve.friction_from_rest[i] = from_rest.friction_ratio;
    curve.dissipation_from_rest[i] = from_rest.dissipation_ratio;
    curve.friction_steady[i] = on_orbit.friction_ratio;
    curve.dissipation_steady[i] = on_orbit.dissipation_ratio;
  });
  return curve;
}

std::vector<double> sliding_velocities_m_per_s(const scene::Scene& scene) {
  const double peak_m_per_s = peak_vibration_m_per_s(scene);
  std::vector<double> velocities;
  velocities.reserve(velocity_ratios().size());
  for (const double ratio : velocity_ratios()) {
    velocities.push_back(ratio * peak_m_per_s);
  }
  return velocities;
}

}  // namespace sonoglide::paper
