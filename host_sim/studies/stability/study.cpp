#include "host_sim/studies/stability/study.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <utility>

#include "host_sim/output/number.hpp"
#include "host_sim/scene/names.hpp"
#include "host_sim/studies/stability/random_scene.hpp"

namespace sonoglide::stability {
namespace {

/// The maps' part of the run time.
constexpr double maps_share = 0.3;

}  // namespace

StabilityStudy study(const MapGrid& grid, std::uint64_t scenes, const Progress& progress) {
  StabilityMaps maps = stability_maps(grid, [&](double part) { progress(maps_share * part); });
  Extremes rows =
      extremes(scenes, [&](double part) { progress(maps_share + (1.0 - maps_share) * part); });
  return {std::move(maps), std::move(rows)};
}

output::StudyReport report(const StabilityStudy& study) {
  return {{{"stability_map.csv", map_csv(study.maps, "float64")},
           {"stability_map.svg", output::print(map_sheet(study.maps, "float64"))},
           {"stability_map_float32.csv", map_csv(study.maps, "float32")},
           {"stability_map_float32.svg", output::print(map_sheet(study.maps, "float32"))},
           {"extremes.csv", extremes_csv(study.extremes)},
           {"extremes_worst.csv", worst_csv(study.extremes)},
           {"report.html", output::to_html(study_page(study))}},
          study_text(study.extremes)};
}

namespace {

constexpr const char* worst_header =
    "solver,precision,setting,verdict,balance_residual,largest_friction,scene,"
    "mass_kg,stiffness_N_per_m,damping_N_s_per_m,initial_displacement_m,initial_velocity_m_per_s,"
    "law,coefficient,normal_force_N,contact_stiffness_N_per_m,initial_force_N,sign_convention,"
    "sliding_begin_m_per_s,sliding_end_m_per_s,frequency_Hz,force_amplitude_N,duration_s\n";

constexpr int csv_digits = 6;

std::string scene_cells(const scene::Scene& scene) {
  const scene::Plant& plant = scene.plant;
  const scene::Friction& friction = scene.friction;
  const std::string drive =
      scene.drive ? fmt::format("{},{}", scene.drive->frequency_Hz, scene.drive->force_amplitude_N)
                  : std::string("nan,nan");
  return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}", plant.mass_kg,
                     plant.stiffness_N_per_m, plant.damping_N_s_per_m, plant.initial_displacement_m,
                     plant.initial_velocity_m_per_s, scene::name_of(friction.law),
                     friction.coefficient, friction.normal_force_N,
                     friction.contact_stiffness_N_per_m, friction.initial_force_N,
                     scene::name_of(scene::sign_conventions, friction.sign_convention),
                     scene.sliding.profile.front().velocity_m_per_s,
                     scene.sliding.profile.back().velocity_m_per_s, drive, scene.run.duration_s);
}

}  // namespace

std::string map_csv(const StabilityMaps& maps, std::string_view precision) {
  const auto names = verdict_names("accurate", "inaccurate");
  std::string text = "solver,setting,contact_stiffness_N_per_m,verdict,relative_error\n";
  for (const SolverMap& map : maps.maps) {
    if (map.precision != precision) {
      continue;
    }
    for (const MapCell& cell : map.cells) {
      text +=
          fmt::format("{},{:.6g},{:.6g},{},{}\n", map.solver, cell.setting,
                      cell.contact_stiffness_N_per_m, names[static_cast<std::size_t>(cell.verdict)],
                      output::csv_number(cell.relative_error, csv_digits));
    }
  }
  return text;
}

std::string extremes_csv(const Extremes& extremes) {
  std::string text = "solver,precision,setting,scenes";
  for (const std::string_view name : verdict_names("good", "silent_imbalance")) {
    text += fmt::format(",{}", name);
  }
  text += ",residual_median,residual_q90,residual_q99,residual_q999,residual_largest\n";
  for (const ExtremeRow& row : extremes.rows) {
    text += fmt::format("{},{},{:g},{}", row.solver, row.precision, row.setting, extremes.scenes);
    for (const std::uint64_t count : row.count) {
      text += fmt::format(",{}", count);
    }
    text += ',' + output::csv_cells({row.residual.begin(), row.residual.end()}, 3) + '\n';
  }
  return text;
}

std::string worst_csv(const Extremes& extremes) {
  const auto names = verdict_names("good", "silent_imbalance");
  std::string text = worst_header;
  for (const ExtremeRow& row : extremes.rows) {
    for (const WorstCase& worst : row.worst) {
      text += fmt::format("{},{},{:g},{},{},{},{},{}\n", row.solver, row.precision, row.setting,
                          names[static_cast<std::size_t>(worst.verdict)],
                          output::csv_number(worst.result.balance_residual, csv_digits),
                          output::csv_number(worst.result.largest_friction), worst.scene,
                          scene_cells(random_scene(worst.scene)));
    }
  }
  return text;
}

namespace {

std::uint64_t sum(const ExtremeRow& row, std::initializer_list<Verdict> verdicts) {
  std::uint64_t total = 0;
  for (const Verdict verdict : verdicts) {
    total += row.count[static_cast<std::size_t>(verdict)];
  }
  return total;
}

}  // namespace

std::string study_text(const Extremes& extremes) {
  std::string text =
      fmt::format("{} random scenes\n{:<24} {:>8} {:>9} {:>14} {:>12}\n", extremes.scenes, "",
                  "good", "declined", "silent: bound", "energy");
  for (const ExtremeRow& row : extremes.rows) {
    text += fmt::format("{:<16} {:<7} {:>8} {:>9} {:>14} {:>12}\n", row.solver, row.precision,
                        sum(row, {Verdict::good}),
                        sum(row, {Verdict::declined_friction_bound, Verdict::declined_step_too_long,
                                  Verdict::declined_not_finite, Verdict::declined_too_many_steps}),
                        sum(row, {Verdict::silent_friction_bound, Verdict::silent_not_finite}),
                        sum(row, {Verdict::wrong}));
  }
  return text;
}

}  // namespace sonoglide::stability
