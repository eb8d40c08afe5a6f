#include "host_sim/sweep/batch_point.hpp"

#include <cmath>
#include <cstdint>

#include "firmware/numeric/turn.hpp"
#include "host_sim/scene/plant_scales.hpp"

namespace sonoglide::sweep {
namespace {

constexpr double map_tolerance = 1e-4;
constexpr double fine_tolerance = 1e-8;

bool suits_lanes(const scene::Scene& scene) {
  const scene::Solver& solver = scene.solver;
  return !scene.controller && scene.run.start == scene::Start::given && scene.drive &&
         scene.drive->waveform == scene::Waveform::cosine &&
         scene.friction.law == scene::FrictionLaw::dahl &&
         scene::friction_limit_N(scene.friction) > 0.0 && scene.sliding.profile.size() == 1 &&
         solver.method == scene::SolverMethod::event_taylor && !solver.order &&
         solver.tolerance >= fine_tolerance;
}

/// A time as a number of carrier periods; absent if it is not a whole one.
std::optional<std::uint32_t> whole_periods(double time_s, double frequency_Hz) {
  constexpr double rounding = 1e-9;
  const double periods = time_s * frequency_Hz;
  const double whole = std::round(periods);
  if (std::abs(periods - whole) > rounding * std::max(1.0, whole) || whole > 4e9) {
    return std::nullopt;
  }
  return static_cast<std::uint32_t>(whole);
}

batch::DahlPlant plant_of(const scene::Scene& scene) {
  const scene::PlantScales scales = scene::plant_scales(scene);
  const scene::PlantNumbers numbers = scene::plant_numbers(scene, scales);
  batch::DahlPlant plant;
  plant.drive_amplitude = scene.drive->force_amplitude_N / scales.force_N;
  plant.damping = numbers.damping;
  plant.stiffness = numbers.stiffness;
  plant.friction_force = numbers.friction_force;
  plant.contact_stiffness = numbers.contact_stiffness;
  plant.sliding_velocity =
      scene.sliding.profile.front().velocity_m_per_s / scales.velocity_m_per_s();
  plant.vibration_sign =
      scene.friction.sign_convention == scene::SignConvention::dissipative ? 1.0 : -1.0;
  plant.initial.displacement = scene.plant.initial_displacement_m / scales.length_m;
  plant.initial.velocity = scene.plant.initial_velocity_m_per_s / scales.velocity_m_per_s();
  plant.initial.friction = scene.friction.initial_force_N / scales.friction_N;
  return plant;
}

}  // namespace

std::optional<BatchPoint> batch_point(const scene::Scene& scene) {
  if (!suits_lanes(scene)) {
    return std::nullopt;
  }
  const double frequency_Hz = scene.drive->frequency_Hz;
  const auto periods = whole_periods(scene.run.duration_s, frequency_Hz);
  const auto window_start = whole_periods(scene.run.window_start_s, frequency_Hz);
  if (!periods || !window_start || *window_start >= *periods) {
    return std::nullopt;
  }
  return BatchPoint{
      plant_of(scene),
      {*periods, *window_start},
      scene.solver.tolerance >= map_tolerance ? batch::Accuracy::map : batch::Accuracy::fine};
}

Row row_of(const BatchPoint& point, const batch::DahlRun& run) {
  const double sliding = point.plant.sliding_velocity;
  const double direction = sliding < 0.0 ? -1.0 : 1.0;
  const double window =
      numeric::two_pi * (point.length.periods - point.length.window_start_periods);
  Row row;
  row.friction_ratio_whole_run = direction * run.whole.friction_ratio;
  row.friction_ratio_window = direction * run.window.friction_ratio;
  row.dissipation_ratio_window =
      sliding == 0.0 ? Row::undefined : run.window.friction_work / (std::abs(sliding) * window);
  return row;
}

}  // namespace sonoglide::sweep
