#include "host_sim/studies/paper/runs.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <cstddef>
#include <limits>

#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/scene_file/reader.hpp"
#include "host_sim/studies/table_1.hpp"

namespace sonoglide::paper {
namespace {

constexpr std::string_view own_method =
    R"(method = "event_taylor"
tolerance = 1e-13
)";
constexpr std::string_view printed_method =
    R"(method = "rk4"
step_s = 1.667e-8
)";
constexpr std::string_view start_from_rest = "duration_periods = 100\n";
/// The free vibration that a start from rest leaves is then a thousandth of the drive's.
constexpr std::string_view start_from_vibration =
    "duration_periods = 200\nwindow_start_periods = 100\n";

struct Parts {
  std::string_view title;
  std::string_view contact;
  std::string_view solver;
  std::string_view run;
  std::string_view start = "";  ///< of the plant
};

std::string text_of(const Parts& parts) {
  return fmt::format(R"(# {}
{}{}
[friction]
{}
{}
[solver]
{}
[run]
{})",
                     parts.title, table_1::plant, parts.start, parts.contact, table_1::motion,
                     parts.solver, parts.run);
}

}  // namespace

std::string table_1_text() {
  return text_of({"The paper's Table 1 at 384 N and a velocity ratio of 0.5, from rest.",
                  table_1::contact(), own_method, start_from_rest});
}

std::string table_2_text() {
  return text_of(
      {"The paper's Table 2: Table 1 and the paper's own solver, 1000 steps in a carrier "
       "period.",
       table_1::contact(), printed_method, start_from_rest});
}

std::string table_1_text(std::string_view contact) {
  return text_of(
      {"The paper's Table 1 at 384 N and a velocity ratio of 0.5, begun on the vibration.", contact,
       own_method, start_from_vibration,
       "initial_displacement_m = -1.4172638629133863e-7   # -Fe/(m w^2 - Ks)\n"});
}

scene::Scene table_1() {
  return scene_file::read_text(table_1_text(), "table_1.toml");
}

scene::Scene at_velocity_ratio(scene::Scene scene, double velocity_ratio) {
  scene.sliding.profile = {{0.0, velocity_ratio * peak_vibration_m_per_s(scene)}};
  return scene;
}

double peak_vibration_m_per_s(const scene::Scene& scene) {
  return configure::peak_vibration_m_per_s(scene.plant, scene.drive->frequency_Hz,
                                           scene.drive->force_amplitude_N);
}

scene::Scene steady(scene::Scene scene) {
  scene.run.start = scene::Start::steady;
  scene.run.duration_s = period_s(scene);
  return scene;
}

double period_s(const scene::Scene& scene) {
  return 1.0 / scene.drive->frequency_Hz;
}

double dahl_number(const scene::Scene& scene) {
  const double amplitude_m =
      scene.drive->force_amplitude_N /
      configure::dynamic_stiffness_N_per_m(scene.plant, scene.drive->rate_rad_per_s());
  return scene.friction.contact_stiffness_N_per_m * amplitude_m / scene.friction.limit_N();
}

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
