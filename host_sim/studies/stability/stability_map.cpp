#include "host_sim/studies/stability/stability_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "firmware/numeric/turn.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/scene/scene.hpp"
#include "host_sim/scene_file/reader.hpp"
#include "host_sim/studies/stability/trial.hpp"
#include "host_sim/studies/table_1.hpp"

namespace sonoglide::stability {
namespace {

constexpr double reference_tolerance = 1e-12;
constexpr double check_tolerance = 1e-13;

const scene::Scene& table_1_scene() {
  static const scene::Scene scene = scene_file::read_text(
      fmt::format(
          "{}[friction]\n{}{}[solver]\nmethod = \"event_taylor\"\n[run]\nduration_periods = 1\n",
          table_1::plant, table_1::contact(), table_1::motion),
      "table_1.toml");
  return scene;
}

scene::Scene scene_of(double contact_stiffness_N_per_m, int periods) {
  scene::Scene scene = table_1_scene();
  scene.friction.contact_stiffness_N_per_m = contact_stiffness_N_per_m;
  scene.run.duration_s = periods / scene.drive->frequency_Hz;
  return scene;
}

/// first, first * factor, … up to last, within rounding.
std::vector<double> geometric(double first, double factor, std::size_t count) {
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    values[i] = first * std::pow(factor, static_cast<double>(i));
  }
  return values;
}

const TriedPrecision& precision_of(std::string_view solver) {
  const auto found = std::find_if(solvers().begin(), solvers().end(),
                                  [&](const TriedSolver& each) { return each.name == solver; });
  return found->precisions.front();
}

struct References {
  std::vector<double> friction_ratio;  ///< for each stiffness
  double difference;
};

References references(const MapGrid& grid) {
  const Trial trial = precision_of("event_taylor_16").trial;
  const Trial check = precision_of("event_taylor_12").trial;
  References result{{}, 0.0};
  for (const double stiffness : grid.contact_stiffness_N_per_m) {
    const scene::Scene scene = scene_of(stiffness, grid.periods);
    const auto ratio = [&](Trial of, double tolerance) {
      return of(scene, {grid.periods, tolerance, plant::max_steps_per_advance}).friction_ratio;
    };
    const double reference = ratio(trial, reference_tolerance);
    const double other = ratio(check, check_tolerance);
    result.friction_ratio.push_back(reference);
    result.difference = std::max(result.difference, std::abs(other / reference - 1.0));
  }
  return result;
}

MapCell cell(const MapGrid& grid, const TriedPrecision& precision, double setting, double stiffness,
             double reference) {
  const TrialResult result = precision.trial(scene_of(stiffness, grid.periods),
                                             {grid.periods, setting, plant::max_steps_per_advance});
  const double error = std::abs(result.friction_ratio / reference - 1.0);
  const Verdict verdict = judge(result, error, accurate_error, precision.friction_bound);
  const bool comparable = result.error == plant::Error::none && result.finite && result.supported;
  return {setting, stiffness, verdict,
          comparable ? error : std::numeric_limits<double>::quiet_NaN()};
}

}  // namespace

MapGrid full_grid() {
  MapGrid grid;
  grid.contact_stiffness_N_per_m = geometric(1e2, std::pow(10.0, 0.25), 45);
  grid.tolerance = geometric(1e-2, std::pow(10.0, -0.5), 25);
  grid.steps_per_period = geometric(8.0, std::sqrt(2.0), 25);
  grid.periods = 10;
  return grid;
}

StabilityMaps stability_maps(const MapGrid& grid, const Progress& progress) {
  const References reference = references(grid);
  StabilityMaps result{grid, {}, reference.difference};
  const std::size_t columns = grid.contact_stiffness_N_per_m.size();
  const std::size_t map_count = 2 * solvers().size();
  for (std::size_t p = 0; p < 2; ++p) {
    for (const TriedSolver& solver : solvers()) {
      const TriedPrecision& precision = solver.precisions[p];
      const std::vector<double>& settings =
          solver.adaptive ? grid.tolerance : grid.steps_per_period;
      SolverMap map{solver.name, precision.name, solver.adaptive, {}};
      map.cells.resize(settings.size() * columns);
      const double begun = static_cast<double>(result.maps.size());
      for_each_index(
          map.cells.size(), 1,
          [&](double part) { progress((begun + part) / static_cast<double>(map_count)); },
          [&](std::size_t i) {
            const std::size_t column = i % columns;
            map.cells[i] =
                cell(grid, precision, settings[i / columns], grid.contact_stiffness_N_per_m[column],
                     reference.friction_ratio[column]);
          });
      result.maps.push_back(std::move(map));
    }
  }
  return result;
}

double rk4_limit_steps_per_period(double contact_stiffness_N_per_m) {
  const scene::Scene& scene = table_1_scene();
  const double frequency_Hz = scene.drive->frequency_Hz;
  // From rest the natural mode adds its part to the steady vibration.
  const double free_part = scene.plant.natural_rad_per_s() / (numeric::two_pi * frequency_Hz);
  const double fastest_m_per_s =
      configure::peak_vibration_m_per_s(scene.plant, frequency_Hz, scene.drive->force_amplitude_N) *
      (table_1::velocity_ratio + 1.0 + free_part);
  const double longest_s = 2.785 * scene.friction.coefficient * scene.friction.normal_force_N /
                           (contact_stiffness_N_per_m * fastest_m_per_s);
  return 1.0 / (frequency_Hz * longest_s);
}

}  // namespace sonoglide::stability
