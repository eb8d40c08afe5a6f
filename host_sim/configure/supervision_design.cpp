#include "host_sim/configure/design_steps.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <variant>
#include <vector>

#include "host_sim/configure/design_periods.hpp"
#include "host_sim/configure/plant_scales.hpp"

namespace sonoglide::configure {
namespace {

/// The undriven friction is the same at every sliding speed of the scene.
bool has_one_level(const scene::Scene& scene) {
  constexpr double same = 0.02;
  const auto friction_N = [&](double sliding_m_per_s) {
    return scene::undriven_friction_N(scene.friction.law, scene.friction, sliding_m_per_s);
  };
  const double fastest_N = friction_N(scene.sliding.fastest_m_per_s());
  const auto& profile = scene.sliding.profile;
  return std::all_of(profile.begin(), profile.end(), [&](const scene::SpeedPoint& point) {
    return std::abs(friction_N(point.velocity_m_per_s) - fastest_N) <= same * fastest_N;
  });
}

bool has_true_map(const scene::Scene& scene, const NominalPlant& plant) {
  constexpr double light_friction = 0.02;  // of the drive
  return scene.drive->waveform == scene::Waveform::cosine && has_one_level(scene) &&
         plant.friction_N < light_friction * scene.max_drive_force_N();
}

/// Under the drive that a vibration takes, friction along it hardly slows it.
bool moves_freely(const NominalPlant& plant, double vibration_m, double stiffness_N_per_m) {
  constexpr double light_friction = 0.2;  // of the drive: it takes 3 % of the velocity
  const double spring_N = plant.contact_stiffness_N_per_m * vibration_m;
  const double friction_N =
      spring_N > 0.0 ? std::min(spring_N, plant.friction_N) : plant.friction_N;
  return friction_N <= light_friction * stiffness_N_per_m * vibration_m;
}

/// So does the vibration of each target at each speed.
bool vibrates_freely(const scene::Scene& scene, const NominalPlant& plant,
                     const ControlDesign& design) {
  if (design.vibration_mode() != scene::VibrationMode::feedforward ||
      scene::vibration_of(scene.friction.law) != friction::Vibration::along) {
    return true;
  }
  const VibrationMap map = design.vibration_map(plant.friction_N);
  const double omega = scene.drive->rate_rad_per_s();
  const double stiffness_N_per_m = dynamic_stiffness_N_per_m(plant, omega);
  const std::vector<double> ratios = plant.target_ratios(*scene.controller);
  const auto& profile = scene.sliding.profile;
  return std::all_of(profile.begin(), profile.end(), [&](const scene::SpeedPoint& point) {
    const double speed_m_per_s = std::abs(point.velocity_m_per_s);
    return speed_m_per_s < design.speed_floor_m_per_s() ||
           std::all_of(ratios.begin(), ratios.end(), [&](double ratio) {
             return ratio >= 1.0 ||
                    moves_freely(plant, map.velocity_m_per_s(ratio, speed_m_per_s) / omega,
                                 stiffness_N_per_m);
           });
  });
}

}  // namespace

void design_supervision(const scene::Scene& scene, const NominalPlant& plant,
                        ControlDesign& design) {
  const double filter = filter_periods(scene, design.scales);
  const double delay = latency_periods(scene) + design.notch_span() + filter;
  constexpr double filter_settling = 4.0;
  constexpr double stuck_margin = 8.0;
  // Normal vibration may leave the ratio where it is, whatever the drive.
  const bool supervised = scene::vibration_of(scene.friction.law) != friction::Vibration::normal;
  design.stuck_periods =
      supervised ? whole_periods(delay + filter_settling * filter + stuck_margin) : 0;
  constexpr double implausible_margin = 16.0;
  // A friction that has jumped shows in full while a pause takes the vibration away.
  const double pause = design.relearns ? 2.0 * design.changing_periods() : 0.0;
  design.implausible_periods = whole_periods(design.hold_periods + implausible_margin + pause);

  constexpr double fall_carriers = 128.0;
  design.standstill_hold_periods = static_cast<std::uint32_t>(std::min(
      4e9, std::round(scene.controller->standstill_hold_s / design.scales.step_period_s())));
  design.standstill_fall = design.scales.every_periods / fall_carriers;

  constexpr double noise_deviations = 4.0;
  constexpr double widest_band = 0.5;
  const double reading =
      (noise_deviations * scene.sensor.reading_noise_N() + code_N(scene.sensor)) / plant.friction_N;
  design.settling_band = 0.5 * std::min(widest_band, scene.run.settling_band + reading);
  constexpr double holds = 4.0;
  constexpr double patience_margin = 40.0;
  const double building_up =
      std::visit([](const auto& mode) { return mode.building_up_periods(); }, design.vibration);
  design.settling_patience_periods =
      whole_periods(holds * design.hold_periods + patience_margin + building_up);
  design.maps_friction = has_true_map(scene, plant);
  design.estimates_mismatch = design.maps_friction && vibrates_freely(scene, plant, design);
  const bool tells =  // a force that is held is right with any friction
      design.estimates_mismatch && !design.holds_force &&
      std::visit([](const auto& mode) { return mode.tells_mismatch(); }, design.vibration);
  design.agreement = tells ? 1.0 / scene.controller->mismatch_warning : 0.0;
}

}  // namespace sonoglide::configure
