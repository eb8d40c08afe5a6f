#include "host_sim/configure/design_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "firmware/numeric/float_elementary.hpp"
#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/configure/design_periods.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/scene/bound.hpp"
#include "host_sim/scene/names.hpp"

namespace sonoglide::configure {
namespace {

/// How many periods a sliding in either direction lasts before a time.
struct SlidingSpells {
  std::uint32_t last = 0;      ///< without a break up to that time
  std::uint32_t opposite = 0;  ///< the longest one the other way
};

double sliding_velocity_m_per_s(const std::vector<scene::SpeedPoint>& profile, std::size_t& place,
                                double time_s) {
  while (place + 1 < profile.size() && profile[place + 1].time_s <= time_s) {
    ++place;
  }
  const scene::SpeedPoint& before = profile[place];
  if (place + 1 == profile.size() || time_s <= before.time_s) {
    return before.velocity_m_per_s;
  }
  const scene::SpeedPoint& after = profile[place + 1];
  const double part = (time_s - before.time_s) / (after.time_s - before.time_s);
  return before.velocity_m_per_s + part * (after.velocity_m_per_s - before.velocity_m_per_s);
}

SlidingSpells sliding_spells(const scene::Scene& scene, const ControlDesign& design,
                             std::uint32_t periods) {
  const std::vector<scene::SpeedPoint>& profile = scene.sliding.profile;
  const double floor_m_per_s = design.speed_floor * design.scales.velocity_m_per_s;
  std::array<std::uint32_t, 2> longest{};
  std::uint32_t length = 0;
  bool backwards = false;
  std::size_t place = 0;
  for (std::uint32_t k = 1; k <= periods; ++k) {
    const double velocity_m_per_s =
        sliding_velocity_m_per_s(profile, place, k * design.scales.step_period_s());
    const bool turned = (velocity_m_per_s < 0.0) != backwards;
    backwards = velocity_m_per_s < 0.0;
    length = std::abs(velocity_m_per_s) < floor_m_per_s ? 0 : (turned ? 1 : length + 1);
    longest[backwards ? 1 : 0] = std::max(longest[backwards ? 1 : 0], length);
  }
  return {length, longest[backwards ? 0 : 1]};
}

/// Half of the largest difference of readings of a mass at rest. Of many the noise alone, of which
/// nobody may have told, sets some far apart: there nothing is too much.
double half_steady_difference(const scene::Scene& scene, const ControlDesign& design,
                              double readings) {
  constexpr double few = 16.0;
  constexpr double part = 0.4;  // of the friction
  constexpr double noise_deviations = 10.0;
  constexpr double anything = 1.0;
  const double told = part * design.friction_force +
                      noise_deviations * scene.sensor.reading_noise_N() / design.scales.force_N;
  return readings > few ? anything : std::min(0.5 * told, anything);
}

/// Of a calibration that the contact slides through so many of its presliding travels.
double calibration_periods(const scene::Scene& scene, const NominalPlant& plant,
                           const ControlDesign& design, double travels) {
  return settling_periods(scene, plant, design, travels) + readings_for_mean(scene, plant) + 2.0;
}

/// calibration_s and friction may both say whether the friction force is calibrated.
void require_no_contradiction(const scene::Scene& scene) {
  const scene::Controller& controller = *scene.controller;
  if (!controller.friction || !controller.calibration_s) {
    return;
  }
  const bool calibrated = controller.friction == scene::FrictionSource::calibrated;
  if (calibrated != (*controller.calibration_s > 0.0)) {
    throw ConfigurationError(
        "controller.calibration_s",
        fmt::format("{:g} s contradicts controller.friction = \"{}\"; allowed: {}",
                    *controller.calibration_s,
                    scene::name_of(scene::friction_sources, *controller.friction),
                    calibrated ? "above 0, or remove it" : "0, or remove it"));
  }
}

}  // namespace

double settling_periods(const scene::Scene& scene, const NominalPlant& plant,
                        const ControlDesign& design, double presliding_travels) {
  constexpr double filter_settling = 5.0;  // 0.7 % of the force is left
  const ControlScales& scales = design.scales;
  const double speed_m_per_s = std::max(std::abs(scene.sliding.profile.front().velocity_m_per_s),
                                        design.speed_floor * scales.velocity_m_per_s);
  return std::ceil(presliding_travels * presliding_m(plant) /
                       (speed_m_per_s * scales.step_period_s()) +
                   filter_settling * filter_periods(scene, scales) +
                   static_cast<double>(scene.sensor.delay_periods) / scales.every_periods);
}

double readings_for_mean(const scene::Scene& scene, const NominalPlant& plant) {
  constexpr double error = 0.0025;
  constexpr double most = 16.0;
  const double noise = scene.sensor.reading_noise_N() / (error * plant.friction_N);
  return std::clamp(std::ceil(noise * noise), 1.0, most);
}

void design_calibration(const scene::Scene& scene, const NominalPlant& plant,
                        ControlDesign& design) {
  design.usual_calibration_s = calibration_periods(scene, plant, design, usual_presliding_travels) *
                               design.scales.step_period_s();
  const double calibration_s = scene.controller->calibration_s.value_or(0.0);
  require_no_contradiction(scene);
  if (calibration_s <= 0.0) {
    return;
  }
  const ControlScales& scales = design.scales;
  const double settling = settling_periods(scene, plant, design, least_presliding_travels);
  const double total = std::round(calibration_s / scales.step_period_s()) - 1.0;
  if (total < settling + 1.0) {
    throw ConfigurationError(
        "controller.calibration_s",
        fmt::format(
            "is too short for contact and sensor to settle; allowed: 0 (no calibration), or "
            "at least {} s",
            scene::at_least((settling + 2.0) * scales.step_period_s(), 3)));
  }
  design.calibrated = true;
  design.calibration_total_periods = static_cast<std::uint32_t>(total);
  const std::vector<scene::TargetStep>& targets = scene.controller->targets();
  design.calibration_outlasts_target = targets.size() > 1 && targets[1].time_s <= calibration_s;
  const SlidingSpells spells = sliding_spells(scene, design, design.calibration_total_periods);
  // A sliding that begins too late for it makes the calibration longer.
  const double last = spells.last > settling ? spells.last : total;
  const double available =
      spells.opposite > settling ? std::min<double>(last, spells.opposite) : last;
  constexpr double most_averaged = 65536.0;  // more would only add up roundings in float32
  const double averaged =
      std::min({available - settling, std::ceil(0.5 * available), most_averaged});
  design.calibration_average_periods = static_cast<std::uint32_t>(averaged);
  design.calibration_settle_periods = static_cast<std::uint32_t>(available - averaged);
  design.calibration_weight = mean_weight(averaged);
  design.calibration_half_steady = half_steady_difference(scene, design, averaged);
}

void design_relearning(const scene::Scene& scene, const NominalPlant& plant,
                       ControlDesign& design) {
  if (!scene.controller->relearn_every_s) {
    return;
  }
  if (scene.controller->friction == scene::FrictionSource::tracked) {
    throw ConfigurationError("controller.relearn_every_s",
                             "not used with controller.friction = \"tracked\"; remove it");
  }
  constexpr double presliding_travels = 6.0;  // 0.15 % of the force is left
  constexpr double filter_settling = 5.0;     // 0.7 % of it
  const ControlScales& scales = design.scales;
  const double shaping = design.changing_periods();
  const double slewing = design.slew_limited ? 1.0 / design.slew_per_period : 0.0;
  design.relearn_quiet_periods =
      whole_periods(shaping + slewing + filter_settling * filter_periods(scene, scales));
  design.relearn_reading_periods = whole_periods(latency_periods(scene));
  design.relearn_return_periods =
      whole_periods(shaping + slewing + contact_settling_periods(scene));
  design.relearn_average_periods = static_cast<std::uint8_t>(readings_for_mean(scene, plant));
  design.relearn_weight = mean_weight(design.relearn_average_periods);
  design.relearn_travel = presliding_travels * presliding_m(plant) /
                          (64.0 * scales.velocity_m_per_s * scales.step_period_s());
  const double every = std::round(*scene.controller->relearn_every_s / scales.step_period_s());
  const double shortest = 10.0 * (design.relearn_quiet_periods + design.relearn_reading_periods +
                                  design.relearn_return_periods + design.relearn_average_periods);
  if (!(every >= shortest && design.relearn_travel < 1.0)) {
    throw ConfigurationError(
        "controller.relearn_every_s",
        design.relearn_travel < 1.0
            ? fmt::format("leaves no time between two pauses of the drive; allowed: at least {} s",
                          scene::at_least(shortest * scales.step_period_s(), 3))
            : fmt::format(
                  "cannot be kept: the presliding travel takes more than {} carrier periods "
                  "at the peak vibration velocity of full drive; remove it",
                  64 * scales.every_periods));
  }
  design.relearn_every_periods = static_cast<std::uint32_t>(std::min(every, 4e9));
}

double shortest_calibration_s(const scene::Scene& scene, const ControlDesign& design) {
  constexpr double largest_part = 0.5;  // of the time of the first target
  const NominalPlant plant = nominal_plant(scene);
  const auto& targets = scene.controller->targets();
  const double first_s =
      targets.size() > 1 ? std::min(targets[1].time_s, scene.run.duration_s) : scene.run.duration_s;
  const double period_s = design.scales.step_period_s();
  const double most = std::floor(largest_part * first_s / period_s);
  const double chosen =
      std::min(calibration_periods(scene, plant, design, usual_presliding_travels), most);
  const double least = calibration_periods(scene, plant, design, least_presliding_travels);
  const auto begun = static_cast<std::uint32_t>(std::max(0.0, chosen));
  return chosen < least || sliding_spells(scene, design, begun).last < least ? 0.0
                                                                             : chosen * period_s;
}

}  // namespace sonoglide::configure
