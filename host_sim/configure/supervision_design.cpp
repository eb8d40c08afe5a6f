#include "host_sim/configure/design_steps.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <variant>

#include "host_sim/configure/design_periods.hpp"

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
  const bool tells =  // a force that is held is right with any friction
      design.maps_friction && !design.holds_force &&
      std::visit([](const auto& mode) { return mode.tells_mismatch(); }, design.vibration);
  design.agreement = tells ? 1.0 / scene.controller->mismatch_warning : 0.0;
}

}  // namespace sonoglide::configure
