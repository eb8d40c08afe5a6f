#include "host_sim/configure/design_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/turn.hpp"
#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/configure/design_periods.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/configure/vibration/notch_design.hpp"
#include "host_sim/scene/names.hpp"

namespace sonoglide::configure {
namespace {

double root_of_squares(double a, double b) {
  return numeric::sqrt(a * a + b * b);
}

/// What the inverse map of a tracked friction lacks; empty: nothing.
std::string missing_for_map(const scene::Scene& scene, const ControlDesign& design) {
  if (design.map != scene::FrictionMap::dahl) {
    return "friction.law = \"dahl\"";
  }
  if (scene.drive->waveform != scene::Waveform::cosine) {
    return "drive.waveform = \"cosine\"";
  }
  return design.maps_friction ? std::string()
                              : "a friction force below 2 % of the largest drive force";
}

void require_trackable(const scene::Scene& scene, const ControlDesign& design) {
  const scene::Controller& controller = *scene.controller;
  const auto refuse = [](const char* key, const std::string& message) {
    throw ConfigurationError(key, message);
  };
  if (controller.vibration) {
    refuse("controller.friction",
           fmt::format(
               "\"tracked\" compares the force with the ratio that the amplitude is fed forward "
               "for, and with controller.vibration = \"{}\" an observer moves the amplitude; "
               "allowed: \"trusted\", \"calibrated\", or no controller.vibration",
               scene::name_of(scene::vibration_controls, *controller.vibration)));
  }
  if (scene.drive->bias_limit_N > 0.0) {
    refuse(
        "controller.friction",
        "\"tracked\" takes the mean force of a few carrier periods for the friction, and the slow mode "
        "that drive.bias_limit_N is for swings for longer; allowed: \"trusted\", \"calibrated\", or "
        "drive.bias_limit_N = 0");
  }
  if (controller.arithmetic == scene::Arithmetic::q15) {
    refuse("controller.arithmetic",
           "\"q15\" is too coarse for controller.friction = \"tracked\"; allowed: \"float32\", "
           "\"q31\", \"float64\"");
  }
  if (const std::string missing = missing_for_map(scene, design); !missing.empty()) {
    refuse("controller.friction",
           fmt::format("\"tracked\" needs {}; allowed: \"trusted\", \"calibrated\"", missing));
  }
}

/// Of ln g, g true over nominal vibration velocity: 2 %, and 5 % of the stiffness. The force factor
/// of a transducer is known within 25 %.
double gain_deviation(const scene::Scene& scene, const NominalPlant& plant) {
  constexpr double drive = 0.02;
  constexpr double stiffness = 0.05;
  constexpr double force_factor = 0.25;
  constexpr double most = 0.3;
  const double omega = scene.drive->rate_rad_per_s();
  const double of_stiffness =
      stiffness * plant.stiffness_N_per_m / dynamic_stiffness_N_per_m(plant, omega);
  return std::min(most, root_of_squares(scene.transducer ? force_factor : drive, of_stiffness));
}

/// Whether a natural mode that rings turns at least once, as the steps see it, in so many of them.
bool turns_within(double steps, const NominalPlant& plant, double step_period_s) {
  const double turns = natural_mode(plant, step_period_s).rotation / numeric::two_pi;
  return steps * std::abs(turns - std::round(turns)) >= 1.0;
}

/// Periods that a reading may wait for the contact: half of the shortest target's time, with what
/// else a reading takes.
/// @param others  what else it takes
double longest_settling(const scene::Scene& scene, const ControlDesign& design, double others) {
  constexpr double part = 0.5;
  const auto& targets = scene.controller->targets();
  double shortest_s = scene.run.duration_s;
  double end_s = scene.run.duration_s;
  for (auto target = targets.rbegin(); target != targets.rend(); ++target) {
    if (target->time_s < end_s) {
      shortest_s = std::min(shortest_s, end_s - target->time_s);
      end_s = target->time_s;
    }
  }
  return std::max(1.0, part * shortest_s / design.scales.step_period_s() - others);
}

}  // namespace

void design_tracking(const scene::Scene& scene, const NominalPlant& plant, ControlDesign& design) {
  if (scene.controller->friction != scene::FrictionSource::tracked) {
    return;
  }
  require_trackable(scene, design);
  constexpr double fewest_readings = 8.0;  // over which a mass that still rings is averaged
  constexpr double map_error = 0.003;      // of the inverse map, in friction ratio
  constexpr double least_noise = 0.0005;   // of a mean force, over the friction force
  constexpr double noise_deviations = 1.5;
  constexpr double highest_deviations = 3.0;  // of a dip's periods over their mean
  constexpr double certain_deviations = 2.5;
  constexpr double surely_beyond = 3.0;  // deviations of the gain
  constexpr double least_edge = 0.25;
  constexpr double most_edge = 0.75;  // whatever the scene says, up to a gain of 1.33
  constexpr double dips = 2.0;        // readings that a dip may take
  const double slewing = design.slew_limited ? 1.0 / design.slew_per_period : 0.0;
  const double readings = std::max(fewest_readings, readings_for_mean(scene, plant));
  const double latency = latency_periods(scene) + design.changing_periods();
  const double settling = settling_periods(scene, plant, design, usual_presliding_travels);
  const double waited = std::min(settling, longest_settling(scene, design, latency + readings));
  design.tracks = true;
  design.tracking_wait_periods = whole_periods(latency + waited);
  design.tracking_average_periods = static_cast<std::uint8_t>(readings);
  design.tracking_dip_periods =
      whole_periods(dips * (design.tracking_wait_periods + readings) + slewing);
  design.tracking_weight = mean_weight(readings);
  design.tracking_unsettled =
      waited < settling ? std::exp(-usual_presliding_travels * waited / settling) : 0.0;
  const double period_noise_N = scene.sensor.reading_noise_N();
  const double rounding_N = code_N(scene.sensor) / numeric::sqrt(12.0);
  const double noise_N = root_of_squares(period_noise_N / numeric::sqrt(readings), rounding_N);
  design.tracking_deviation = root_of_squares(root_of_squares(map_error, design.tracking_unsettled),
                                              noise_N / plant.friction_N);
  design.tracking_noise = std::max(least_noise, noise_deviations * noise_N / plant.friction_N);
  // Less than two deviations of a reading is in the interval of Fc in any case.
  design.tracking_scatter =
      std::max(2.0 * design.tracking_deviation,
               highest_deviations * root_of_squares(period_noise_N, rounding_N) / plant.friction_N);
  design.tracking_shows_ringing = turns_within(readings, plant, design.scales.step_period_s());
  design.tracking_certain =
      std::max(scene.run.settling_band, certain_deviations * design.tracking_deviation);
  design.gain_deviation = gain_deviation(scene, plant);
  design.tracking_edge =
      std::clamp(1.0 - surely_beyond * design.gain_deviation, least_edge, most_edge);
  // A friction that has jumped shows in full in a dip.
  design.implausible_periods =
      whole_periods(design.implausible_periods + design.tracking_wait_periods + readings + slewing);
}

}  // namespace sonoglide::configure
