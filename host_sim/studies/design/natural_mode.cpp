#include "host_sim/studies/design/natural_mode.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/configure/experiment.hpp"
#include "host_sim/configure/nominal_plant.hpp"
#include "host_sim/configure/vibration/bias_design.hpp"
#include "host_sim/configure/vibration/ramp_design.hpp"
#include "host_sim/loop/plant/failure.hpp"
#include "host_sim/report/step_metrics.hpp"
#include "host_sim/scene/friction_laws.hpp"
#include "host_sim/scene/names.hpp"

namespace sonoglide::design {
namespace {

constexpr int carriers_on_a_side = 8;
constexpr double carrier_step = 0.015;  // relative
constexpr int plants_a_carrier = 8;
constexpr std::size_t most_targets = 3;

/// Of a target in the loops that are tried: a slow mode has a few cycles to come to rest.
int step_periods(double natural_per_carrier) {
  constexpr double cycles = 10.0;
  return static_cast<int>(std::clamp(std::ceil(cycles / natural_per_carrier), 100.0, 2000.0));
}

/// The loop of a scene, fed forward from rest, on a friction that it knows.
scene::Scene fed_forward(scene::Scene scene) {
  scene.controller->vibration.reset();
  scene.controller->calibration_s = 0.0;
  scene.controller->friction.reset();
  scene.controller->relearn_every_s.reset();
  scene.sensor.vibration.reset();
  if (!scene.sensor.force) {
    scene.sensor.force = true;
    scene.sensor.force_full_scale_N = 2.0 * scene.friction.largest_limit_N();
  }
  scene.drive->bias_limit_N = 0.0;
  scene.plant.initial_displacement_m = 0.0;
  scene.plant.initial_velocity_m_per_s = 0.0;
  scene.friction.initial_force_N = 0.0;
  scene.model_error.coefficient = 1.0;
  return scene;
}

/// The scene with a few of its targets, each for a while, at one speed.
scene::Scene trial(scene::Scene scene, const std::vector<double>& ratios, double sliding_m_per_s,
                   double frequency_Hz, int periods) {
  scene.drive->frequency_Hz = frequency_Hz;
  scene.sliding.profile = {{0.0, sliding_m_per_s}};
  scene.run.record.clear();
  scene.run.window_start_s = 0.0;
  scene.controller->target_friction_force_N.clear();
  auto& targets = scene.controller->target_friction_ratio;
  targets.clear();
  // From rest to the strongest drive, and on: the largest change comes first.
  for (std::size_t i = 0; i < std::min(ratios.size(), most_targets); ++i) {
    targets.push_back({static_cast<double>(i) * periods / frequency_Hz, ratios[i]});
  }
  scene.run.duration_s = static_cast<double>(targets.size()) * periods / frequency_Hz;
  constexpr double quick = 1e-6;
  scene.solver.tolerance = std::max(scene.solver.tolerance, quick);
  return scene;
}

enum class Outcome { settled, late, never };

Outcome outcome_of(const configure::Experiment& experiment) try {
  Outcome worst = Outcome::settled;
  const double prompt_s = prompt_periods / experiment.plant.drive->frequency_Hz;
  for (const report::StepMetrics& step :
       report::measured_steps(experiment.plant, *experiment.design)) {
    if (!step.settling_time_s) {
      return Outcome::never;
    }
    worst = *step.settling_time_s > prompt_s ? Outcome::late : worst;
  }
  return worst;
} catch (const loop::ComputationError&) {
  return Outcome::never;
}

/// Whether the largest drive gives the vibration that the lowest ratio needs.
bool has_force(const configure::ControlDesign& design, double lowest_ratio,
               double sliding_m_per_s) {
  return design.vibration_map(design.friction_force * design.scales.force_N)
             .velocity_m_per_s(lowest_ratio, sliding_m_per_s) < design.scales.velocity_m_per_s;
}

Tally try_plants(const scene::Scene& nominal, double stiffness_range) {
  Tally tally;
  for (int i = 0; i < plants_a_carrier; ++i) {
    scene::Scene plant = nominal;
    const double part = 2.0 * i / (plants_a_carrier - 1) - 1.0;
    plant.plant.stiffness_N_per_m *= 1.0 + stiffness_range * part;
    switch (outcome_of(configure::make_experiment(nominal, std::move(plant)))) {
      case Outcome::settled:
        ++tally.settled;
        break;
      case Outcome::late:
        ++tally.late;
        break;
      case Outcome::never:
        ++tally.never;
        break;
    }
  }
  return tally;
}

/// With the other way of the amplitude the design chooses what goes with it.
scene::Scene with_drive(scene::Scene scene, scene::Interpolation interpolation) {
  if (scene.drive->interpolation != interpolation) {
    scene.drive->interpolation = interpolation;
    scene.controller->shaping = interpolation == scene::Interpolation::step
                                    ? std::optional(scene::Shaping::notch)
                                    : std::nullopt;
  }
  return scene;
}

/// @param nominal  a trial at the scene's carrier
QuietDrive quiet_drive(const scene::Scene& nominal, double stiffness_range) {
  const configure::ControlDesign design = configure::design_control(nominal);
  const auto& mode = *design.in_mode<configure::FeedforwardDesign>();
  return {nominal.drive->interpolation,
          mode.quieting,
          mode.notch ? mode.notch->tap_count : 0,
          mode.changing_periods() * design.scales.every_periods,
          configure::left_behind(nominal, configure::nominal_plant(nominal), design, mode.notch),
          try_plants(nominal, stiffness_range)};
}

CarrierPoint carrier_point(const scene::Scene& nominal, const NaturalModeStudy& study) {
  CarrierPoint point;
  point.frequency_Hz = nominal.drive->frequency_Hz;
  point.mode_per_carrier = study.natural_Hz / point.frequency_Hz;
  point.from_multiple = std::abs(point.mode_per_carrier - std::round(point.mode_per_carrier));
  const auto& targets = nominal.controller->target_friction_ratio;
  try {
    point.reachable = has_force(configure::design_control(nominal), targets.front().value,
                                nominal.sliding.profile.front().velocity_m_per_s);
  } catch (const configure::ConfigurationError&) {
    point.reachable = false;
  }
  if (point.reachable) {
    point.plants = try_plants(nominal, study.stiffness_range);
  }
  return point;
}

bool is_better(const QuietDrive& a, const QuietDrive& b) {
  return std::tuple(a.plants.never, a.plants.late, a.changing_periods) <
         std::tuple(b.plants.never, b.plants.late, b.changing_periods);
}

/// No observer is in 16 bits.
void widen(scene::Controller& controller) {
  if (controller.arithmetic == scene::Arithmetic::q15) {
    controller.arithmetic = scene::Arithmetic::q31;
  }
}

/// @param nominal  a trial at the scene's carrier
std::optional<BiasedDrive> biased_drive(scene::Scene nominal, double stiffness_range) {
  const configure::NominalPlant plant = configure::nominal_plant(nominal);
  const double natural = plant.natural_rad_per_s() / nominal.drive->rate_rad_per_s();
  if (nominal.transducer || !scene::vibrates_along(nominal.friction.law) ||
      nominal.drive->waveform != scene::Waveform::cosine || !(natural < configure::slow_mode) ||
      !(natural < configure::fastest_biased_mode(nominal.drive->delay_periods))) {
    return std::nullopt;
  }
  BiasedDrive biased;
  nominal.controller->vibration = scene::VibrationControl::damped;
  nominal.controller->shaping = std::nullopt;
  widen(*nominal.controller);
  nominal.sensor.vibration = scene::VibrationSensor::velocity;
  biased.limit_N = configure::wanted_bias_N(nominal, plant);
  nominal.drive->bias_limit_N = biased.limit_N;
  try {
    biased.plants = try_plants(nominal, stiffness_range);
  } catch (const configure::ConfigurationError&) {
    return std::nullopt;  // no such loop
  }
  return biased;
}

/// As the first target of the scene leaves time for; with the parts of the loop.
scene::FrictionSource friction_source(const scene::Scene& stated, scene::Scene loop) {
  loop.controller->target_friction_ratio = stated.controller->target_friction_ratio;
  loop.controller->target_friction_force_N = stated.controller->target_friction_force_N;
  loop.run.duration_s = stated.run.duration_s;
  const configure::ControlDesign design = configure::design_control(loop);
  if (configure::shortest_calibration_s(loop, design) > 0.0) {
    return scene::FrictionSource::calibrated;
  }
  const bool fed_forward = design.vibration_mode() == scene::VibrationMode::feedforward;
  return fed_forward && !design.bias && design.maps_friction && !design.holds_force &&
                 design.map == scene::FrictionMap::dahl
             ? scene::FrictionSource::tracked
             : scene::FrictionSource::trusted;
}

/// Puts the recommended means into a loop that is fed forward.
void equip(scene::Scene& loop, const RecommendedLoop& recommended) {
  const configure::RecommendedMeans& means = recommended.means;
  loop.controller->shaping.reset();
  loop.controller->shaping_range.reset();
  if (means.shaping_range > 0.0) {
    loop.controller->shaping = scene::Shaping::robust;
    loop.controller->shaping_range = means.shaping_range;
  }
  loop.drive->interpolation =
      means.ramped() ? scene::Interpolation::linear : scene::Interpolation::step;
  loop.drive->codes_per_period = means.codes_per_period;
  loop.drive->bias_limit_N = recommended.bias_limit_N;
  if (means.sensorless) {
    loop.controller->vibration = scene::VibrationControl::damped;
    loop.controller->every_periods = 1;
    loop.drive->max_force_slew_N_per_s.reset();
  }
  if (means.sensorless || means.biased) {
    widen(*loop.controller);
  }
}

std::string quoted(std::string_view word) {
  return fmt::format("\"{}\"", word);
}

std::vector<SceneLine> scene_lines(const scene::Scene& stated, const RecommendedLoop& loop) {
  const configure::RecommendedMeans& means = loop.means;
  std::vector<SceneLine> lines;
  if (means.ramped()) {
    const auto linear = scene::name_of(scene::interpolations, scene::Interpolation::linear);
    lines.push_back({"drive", "interpolation", quoted(linear)});
    lines.push_back({"drive", "codes_per_period", fmt::format("{}", means.codes_per_period)});
  }
  if (means.biased) {
    lines.push_back({"drive", "bias_limit_N", fmt::format("{:.3g}", loop.bias_limit_N)});
  }
  if (means.sensorless) {
    const auto damped = scene::name_of(scene::vibration_controls, scene::VibrationControl::damped);
    lines.push_back({"controller", "vibration", quoted(damped)});
  }
  if (means.shaping_range > 0.0) {
    const auto robust = scene::name_of(scene::shapings, scene::Shaping::robust);
    lines.push_back({"controller", "shaping", quoted(robust)});
    lines.push_back({"controller", "shaping_range", fmt::format("{}", means.shaping_range)});
  }
  lines.push_back(
      {"controller", "friction", quoted(scene::name_of(scene::friction_sources, loop.friction))});
  if ((means.sensorless || means.biased) &&
      stated.controller->arithmetic == scene::Arithmetic::q15) {
    lines.push_back({"controller", "arithmetic",
                     quoted(scene::name_of(scene::arithmetics, scene::Arithmetic::q31))});
  }
  return lines;
}

/// A calibration is for a loop whose friction is calibrated, and that needs one.
bool contradicts_calibration(const scene::Controller& stated, scene::FrictionSource friction) {
  return stated.calibration_s &&
         (*stated.calibration_s > 0.0) != (friction == scene::FrictionSource::calibrated);
}

/// What a scene says otherwise than its recommended loop.
std::vector<std::string> contradicting_keys(const scene::Scene& stated,
                                            const RecommendedLoop& loop) {
  const scene::Controller& controller = *stated.controller;
  std::vector<std::string> keys;
  const bool observed = loop.means.sensorless;
  const bool designed = !(loop.means.shaping_range > 0.0);
  if (designed && controller.shaping &&
      (observed || *controller.shaping != scene::Shaping::notch)) {
    keys.emplace_back("controller.shaping");
  }
  if (designed && controller.shaping_range) {
    keys.emplace_back("controller.shaping_range");
  }
  if (contradicts_calibration(controller, loop.friction)) {
    keys.emplace_back("controller.calibration_s");
  }
  if (controller.relearn_every_s && loop.friction == scene::FrictionSource::tracked) {
    keys.emplace_back("controller.relearn_every_s");
  }
  if (observed && controller.every_periods != 1) {
    keys.emplace_back("controller.every_periods");
  }
  if (observed && stated.drive->max_force_slew_N_per_s) {
    keys.emplace_back("drive.max_force_slew_N_per_s");
  }
  return keys;
}

bool names_no_means(const scene::Scene& stated) {
  return stated.drive->interpolation == scene::Interpolation::step &&
         !(stated.drive->bias_limit_N > 0.0) && !stated.controller->vibration;
}

/// What the trials leave out, such as a sliding that turns, may be none of the loop's.
/// @throws configure::ConfigurationError  the whole scene cannot have it
void require_in(scene::Scene scene, const RecommendedLoop& loop) {
  equip(scene, loop);
  scene.controller->friction = loop.friction;
  if (contradicts_calibration(*scene.controller, loop.friction)) {
    scene.controller->calibration_s.reset();
  }
  configure::design_control(scene);
}

/// @param nominal  a trial at the scene's carrier
RecommendedLoop recommended_loop(const scene::Scene& stated, scene::Scene nominal,
                                 double stiffness_range) {
  const configure::NominalPlant plant = configure::nominal_plant(nominal);
  const double natural = plant.natural_rad_per_s() / nominal.drive->rate_rad_per_s();
  RecommendedLoop found;
  found.means = configure::recommended_means(natural, scene::vibrates_along(stated.friction.law));
  equip(nominal, found);
  if (found.means.biased) {
    found.bias_limit_N = configure::wanted_bias_N(nominal, plant);
    nominal.drive->bias_limit_N = found.bias_limit_N;
  }
  try {
    found.friction = friction_source(stated, nominal);
    if (found.friction == scene::FrictionSource::trusted) {
      nominal.model_error.coefficient = stated.model_error.coefficient;
    }
    require_in(stated, found);
    found.plants = try_plants(nominal, stiffness_range);
  } catch (const configure::ConfigurationError& error) {
    found.refused = fmt::format("{}: {}", error.key(), error.what());
  }
  found.lines = scene_lines(stated, found);
  found.leaves = contradicting_keys(stated, found);
  found.unnamed = names_no_means(stated);
  return found;
}

/// Of what the trials do not know: the friction coefficient they do.
bool has_model_error(const scene::Scene& scene) {
  const scene::ModelError& error = scene.model_error;
  return error.mass != 1.0 || error.stiffness != 1.0 || error.contact_stiffness != 1.0 ||
         error.force_factor != 1.0 || error.damping != 1.0;
}

/// The carrier at which the most plants settle; between equals the nearest to the scene's own.
/// @param own_settled  what counts as settled at the scene's own
std::size_t best_carrier(const NaturalModeStudy& study, int own_settled) {
  const auto rank = [&](std::size_t i) {
    const std::size_t distance = i > study.own ? i - study.own : study.own - i;
    return std::pair(
        i == study.own ? own_settled : static_cast<int>(study.carriers[i].plants.settled),
        study.carriers.size() - distance);
  };
  std::size_t best = study.own;
  for (std::size_t i = 0; i < study.carriers.size(); ++i) {
    best = rank(i) > rank(best) ? i : best;
  }
  return best;
}

}  // namespace

std::optional<std::size_t> recommended_carrier(const NaturalModeStudy& study) {
  const std::size_t own = study.carriers[study.own].plants.settled;
  const std::size_t best = best_carrier(study, static_cast<int>(own + worth_a_change - 1));
  return study.carriers[best].plants.settled > 0 ? std::optional(best) : std::nullopt;
}

const CarrierPoint& best_other_carrier(const NaturalModeStudy& study) {
  return study.carriers[best_carrier(study, -1)];
}

std::optional<NaturalModeStudy> natural_mode_study(const scene::Scene& stated,
                                                   const std::vector<double>& ratios,
                                                   double sliding_m_per_s) {
  const double critical = 2.0 * std::sqrt(stated.plant.stiffness_N_per_m * stated.plant.mass_kg);
  if (stated.resonant() || !(stated.plant.damping_N_s_per_m < critical)) {
    return std::nullopt;
  }
  const scene::Scene scene = fed_forward(stated);
  NaturalModeStudy study;
  study.natural_Hz = scene.plant.natural_Hz();
  study.range = configure::assumed_frequency_range(scene);
  study.assumed_range = configure::natural_frequency_range(scene.tolerances) == 0.0;
  study.stiffness_range = 2.0 * study.range;
  study.model_error = has_model_error(scene);
  study.plants = plants_a_carrier;
  study.targets = std::min(ratios.size(), most_targets);
  study.own = carriers_on_a_side;
  study.carriers.resize(2 * carriers_on_a_side + 1);
  const double own_Hz = stated.drive->frequency_Hz;
  study.step_periods = step_periods(study.natural_Hz / own_Hz);
  const auto tried_at = [&](const scene::Scene& each, double frequency_Hz) {
    return trial(each, ratios, sliding_m_per_s, frequency_Hz, study.step_periods);
  };
  for (const auto& each : scene::interpolations) {
    study.drives.push_back(
        quiet_drive(tried_at(with_drive(scene, each.value), own_Hz), study.stiffness_range));
  }
  const auto best = std::min_element(study.drives.begin(), study.drives.end(), is_better);
  study.best_drive = static_cast<std::size_t>(best - study.drives.begin());
  const scene::Scene driven = with_drive(scene, best->interpolation);
  tbb::parallel_for(std::size_t{0}, study.carriers.size(), [&](std::size_t i) {
    const double away = carrier_step * (static_cast<double>(i) - carriers_on_a_side);
    study.carriers[i] = carrier_point(tried_at(driven, own_Hz * (1.0 + away)), study);
  });
  study.recommended = recommended_carrier(study);
  study.recommended_loop = recommended_loop(stated, tried_at(scene, own_Hz), study.stiffness_range);
  study.bias = biased_drive(tried_at(scene, own_Hz), study.stiffness_range);
  return study;
}

}  // namespace sonoglide::design
