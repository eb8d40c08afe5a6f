#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>
#include <string>
#include <vector>

#include "host_sim/scene/names.hpp"
#include "host_sim/scene/solver_facts.hpp"
#include "host_sim/scene/solver_methods.hpp"
#include "host_sim/scene_file/key.hpp"
#include "host_sim/scene_file/keys.hpp"
#include "host_sim/scene_file/member.hpp"
#include "host_sim/scene_file/uses.hpp"

// How a scene is run, and by whom: solver, run, controller, sensor and model_error.

namespace sonoglide::scene_file {
namespace {

constexpr Range sensor_gain_range{-100.0, 100.0};

/// The numbers or words that solvers have, each with its method.
template <class TextOf>
std::string by_method(const char* separator, const TextOf& text_of) {
  std::string words;
  scene::for_each_solver([&](auto described, scene::SolverMethod /*method*/) {
    const std::string text = text_of(described);
    if (!text.empty()) {
      words += fmt::format("{}{} with {}", words.empty() ? "" : separator, text,
                           decltype(described)::name);
    }
  });
  return words;
}

std::string default_tolerances() {
  return by_method(", ", [](auto described) -> std::string {
    if constexpr (decltype(described)::adaptive) {
      return fmt::format("{}", decltype(described)::default_tolerance);
    }
    return "";
  });
}

std::string built_orders() {
  return by_method("; ", [](auto described) -> std::string {
    using Described = decltype(described);
    return Described::takes_order ? fmt::format("{}", fmt::join(Described::orders, ", ")) : "";
  });
}

std::optional<double> default_tolerance(const scene::Scene& scene) {
  return scene::with_solver(scene.solver.method, [](auto described) {
    std::optional<double> tolerance;
    if constexpr (decltype(described)::adaptive) {
      tolerance = decltype(described)::default_tolerance;
    }
    return tolerance;
  });
}

}  // namespace

std::vector<Key> solver_keys() {
  using scene::Solver;
  const std::string longest = uses::methods_where(scene::takes_longest_step);
  return {
      {"method", choice<scene::solver_methods, &scene::Scene::solver, &Solver::method>(),
       Word{words_of(scene::solver_methods)},
       Rule{"event_gauss where it is the faster, else event_taylor"},
       "how the motion is computed; the summary and the echo name the method that was taken"},
      {"tolerance", of_solver<&Solver::tolerance>, Number{{1e-15, 1e-2}},
       Rule{default_tolerances(), default_tolerance},
       "event_taylor, event_gauss: error of the friction ratio over a hundred carrier periods that "
       "the method aims at; strang: limit of the defects of velocity and energy in each step",
       uses::method(scene::is_adaptive)},
      {"order", of_solver<&Solver::order>, Integer{1, 99}, Rule{"the one that suits the tolerance"},
       fmt::format("order of the method, one of those that are built: {}", built_orders()),
       uses::method(scene::takes_order)},
      {"step_s", OrZero{of_solver<&Solver::step_s>}, Number{{1e-15, 1.0, "s"}},
       Rule{fmt::format("required; no limit with {}", longest),
            [](const scene::Scene& scene) {
              return scene::is_adaptive(scene.solver.method) ? std::optional(0.0) : std::nullopt;
            }},
       fmt::format("length of the steps, shortened so that a whole number of them fills a carrier "
                   "period; the longest step with {}",
                   longest),
       uses::method([](scene::SolverMethod method) {
         return !scene::is_adaptive(method) || scene::takes_longest_step(method);
       })},
  };
}

std::vector<Key> run_keys() {
  using scene::Run;
  const Run run;
  return {
      {"start", choice<scene::starts, &scene::Scene::run, &Run::start>(),
       Word{words_of(scene::starts)}, scene::name_of(scene::starts, run.start),
       "given: from the initial state; steady: on the periodic orbit, for which drive, sliding and "
       "friction must be constant",
       uses::open_loop("in closed loop, which begins with the drive off")},
      {"duration_s",
       of_run<&Run::duration_s>,
       Number{{1e-12, 1e9, "s"}},
       Instead{"duration_periods"},
       "simulated time",
       uses::always,
       {"duration_periods"}},
      {"duration_periods", Periods{of_run<&Run::duration_s>},
       Number{{1e-3, most_periods, "periods"}}, Instead{"duration_s"},
       "simulated time in carrier periods", uses::a_period},
      {"window_start_s",
       of_run<&Run::window_start_s>,
       Number{time_range},
       run.window_start_s,
       "start of the window over which means are taken; the window ends with the run",
       uses::always,
       {"window_start_periods"}},
      {"window_start_periods", Periods{of_run<&Run::window_start_s>},
       Number{{0.0, most_periods, "periods"}}, Rule{"window_start_s"},
       "the same in carrier periods, in place of window_start_s", uses::a_period},
      {"settling_band", of_run<&Run::settling_band>, Number{{0.0, 1.0, "", true}},
       run.settling_band,
       "half width of the band around a target, in friction ratio; a step settles when the "
       "ratio enters the band for good, and never if it leaves it in the last tenth of the step. Of a "
       "target force: times the friction limit at 0 s",
       uses::closed_loop},
      {"record", of_run<&Run::record>, WordList{words_of(scene::channels)},
       Rule{"nothing is recorded"}, "channels that trace.csv records"},
      {"record_interval_s", of_run<&Run::record_interval_s>, Number{{1e-15, 1e9, "s"}},
       Rule{"required if record names a channel"}, "time between two rows of trace.csv",
       uses::recording},
  };
}

std::vector<Key> controller_keys() {
  using scene::Controller;
  const Controller controller;
  return {
      {"arithmetic",
       choice<scene::arithmetics, &scene::Scene::controller, &Controller::arithmetic>(),
       Word{words_of(scene::arithmetics)}, Required{},
       "number type in which the controller computes; not q15 with controller.vibration"},
      {"vibration",
       choice<scene::vibration_controls, &scene::Scene::controller, &Controller::vibration>(),
       Word{words_of(scene::vibration_controls)},
       Rule{"the drive is fed forward, at a fixed frequency"},
       "resonant: the controller observes the vibration, follows the plant's resonance with the "
       "drive frequency and controls the vibration velocity; needs [transducer]. damped: at a fixed "
       "frequency off resonance, with the natural mode damped by feedback. The mode is measured by "
       "sensor.vibration, or without it estimated from the friction force",
       uses::closed_loop},
      {"frequency_range_Hz", of_controller<&Controller::frequency_range_Hz>,
       Interval{frequency_range}, Rule{"5 % below to 5 % above drive.frequency_Hz"},
       "lowest and highest frequency of the drive, below and above drive.frequency_Hz, within 6 % "
       "of it",
       uses::resonance(uses::in_another_mode)},
      {"target_friction_ratio",
       of_controller<&Controller::target_friction_ratio>,
       Profile{time_range, {0.0, 1.0, "", true}},
       Instead{"target_friction_force_N or target_texture"},
       "target friction ratio, constant from each time to the next; the first time is 0",
       uses::always,
       {"target_friction_force_N", "target_texture"}},
      {"target_friction_force_N", of_controller<&Controller::target_friction_force_N>,
       Profile{time_range, {0.0, largest_force_N, "N", true}},
       Instead{"target_friction_ratio or target_texture"},
       "target of the mean friction force along the sliding, constant from each time to the next; the "
       "first time is 0. Feedback acts on the force itself, so that the friction may be believed wrong, "
       "and may change. At most the friction that the scene has",
       uses::needed_force_sensor},
      {"target_texture", of_controller<&Controller::texture>,
       TextureTable{{1e-12, 1e3, "m"}, {0.0, 1.0, "", true}, {0.0, largest_force_N, "N", true}},
       Instead{"target_friction_ratio or target_friction_force_N"},
       "target that repeats itself along the sliding distance, which the controller integrates from the "
       "velocity that it is given: values at equal distances over one period of period_m, the first at "
       "distance 0, linear between them and from the last to the first. ratio: friction ratios. force_N: "
       "mean friction forces, which need a force sensor and are at most the friction that the scene has. "
       "A period takes at least 8 steps of the controller at the fastest sliding"},
      {"every_periods", of_controller<&Controller::every_periods>, Integer{1, 16, "periods"},
       static_cast<double>(controller.every_periods),
       "carrier periods in a step of the controller, for a processor that is too slow for one in each: it "
       "sees the last of them and changes the drive once",
       uses::no_observed_vibration},
      {"friction",
       choice<scene::friction_sources, &scene::Scene::controller, &Controller::friction>(),
       Word{words_of(scene::friction_sources)},
       Rule{"calibrated with a calibration_s above 0, else trusted"},
       "where the controller has the friction force from. trusted: from the scene. calibrated: "
       "measured in calibration_s. tracked: learnt while driving, with the contact stiffness and the "
       "gain of the vibration; for law dahl, a cosine and a drive that is fed forward, without a bias "
       "(with drive.bias_limit_N use \"calibrated\")",
       uses::force_sensor},
      {"calibration_s", of_controller<&Controller::calibration_s>, Number{time_range},
       Rule{
           "0; with friction = \"calibrated\", or with damped and without sensor.vibration, the settling time of the sensor and of a "
           "contact half as stiff as nominal, at most half of the first target's time, and 0 where "
           "that is too short"},
       "time with the drive off in which the friction force is calibrated; 0: the controller takes "
       "the scene's",
       uses::force_sensor},
      {"shaping", choice<scene::shapings, &scene::Scene::controller, &Controller::shaping>(),
       Word{words_of(scene::shapings)},
       Rule{
           "notch; with drive.interpolation = \"linear\" a notch, of three taps or five, only where "
           "the ramp of the drive leaves too much and the notch helps"},
       "filter between target and drive. notch: cancels the ringing of the natural mode. robust: "
       "the same for a mode that is only known within shaping_range",
       uses::no_observed_vibration},
      {"shaping_range", of_controller<&Controller::shaping_range>,
       Number{{scene::least_shaping_range, scene::most_shaping_range}},
       Rule{
           "from the tolerances of stiffness and mass; without these the widest range, up to 0.1, in "
           "which at most 5 % of the ringing is left, and where there is none the notch"},
       "largest error of the natural frequency, relative to the nominal one; the robust notch has "
       "its zeros in this range",
       uses::implied(uses::no_observed_vibration) + uses::robust_shaping},
      {"speed_floor_m_per_s", of_controller<&Controller::speed_floor_m_per_s>,
       Number{{1e-12, largest_speed_m_per_s, "m/s"}},
       Rule{
           "velocity at which the presliding distance takes three carrier periods; at most half of "
           "the fastest sliding and of the largest vibration velocity"},
       "sliding velocity below which the drive is held"},
      {"standstill_hold_s", of_controller<&Controller::standstill_hold_s>, Number{time_range},
       controller.standstill_hold_s,
       "time for which the drive is held below the speed floor before it falls to 0"},
      {"relearn_every_s", of_controller<&Controller::relearn_every_s>, Number{{1e-9, 1e9, "s"}},
       Rule{"never"},
       "time between two pauses of the drive in which the friction force is calibrated again",
       uses::force_sensor + uses::ratio_target + uses::steady_target},
      {"mismatch_warning", of_controller<&Controller::mismatch_warning>, Number{{1.01, 100.0}},
       controller.mismatch_warning,
       "the limit mismatch is reported once nominal over true friction, or its inverse, reaches "
       "this value",
       uses::force_sensor + uses::ratio_target},
  };
}

std::vector<Key> sensor_keys() {
  using scene::Sensor;
  const Sensor sensor;
  const Uses& with_force = uses::force_sensor;
  const Uses& seen = uses::vibration_sensor;
  return {
      {"force", of_sensor<&Sensor::force>, Truth{}, Rule{"true"},
       "whether there is a sensor of the friction force; false: the controller holds the vibration "
       "that gives the ratio with the nominal friction",
       uses::observed_vibration},
      {"adc_bits", of_sensor<&Sensor::adc_bits>, Integer{4, 32, "bits"}, Rule{"ideal"},
       "resolution of the force converter", with_force},
      {"force_full_scale_N", of_sensor<&Sensor::force_full_scale_N>,
       Number{{1e-15, largest_force_N, "N"}},
       Rule{"2 * coefficient * normal_force_N, of profiles the largest",
            [](const scene::Scene& scene) {
              return std::optional(2.0 * scene.friction.largest_limit_N());
            }},
       "largest force that the converter reads, in both directions", with_force},
      {"force_noise_N", of_sensor<&Sensor::force_noise_N>, Number{force_range},
       sensor.force_noise_N, "noise of each sample of the force, rms", with_force},
      {"force_bandwidth_Hz", of_sensor<&Sensor::force_bandwidth_Hz>, Number{{1e-3, 1e12, "Hz"}},
       Rule{"no limit"},
       "bandwidth of the force sensor, a low-pass of first order on the mean over a carrier period",
       with_force + uses::mean_force},
      {"samples_per_period", of_sensor<&Sensor::samples_per_period>, Integer{1, 1024, "samples"},
       Rule{"the exact mean, converted once"},
       "conversions of the force in a carrier period, equally spaced, the last at its end; their mean is the "
       "reading. Each has the noise and the resolution of the converter",
       with_force},
      {"filter_Hz", of_sensor<&Sensor::filter_Hz>, Number{{1e-3, 1e12, "Hz"}}, Rule{"no filter"},
       "bandwidth of a low-pass of first order before these conversions",
       with_force + uses::sampled_force},
      {"delay_periods", of_sensor<&Sensor::delay_periods>, Integer{0, 64, "periods"},
       static_cast<double>(sensor.delay_periods),
       "carrier periods by which the force reading is late", with_force},
      {"force_offset_N", of_sensor<&Sensor::force_offset_N>,
       Number{{-largest_force_N, largest_force_N, "N"}}, sensor.force_offset_N,
       "force read while the true force is 0", with_force},
      {"force_gain", of_sensor<&Sensor::force_gain>, Number{sensor_gain_range}, sensor.force_gain,
       "force read over true force; -1: wired backwards, 0: dead", with_force},
      {"velocity_offset_m_per_s", of_sensor<&Sensor::velocity_offset_m_per_s>, Number{speed_range},
       sensor.velocity_offset_m_per_s, "sliding velocity read at standstill"},
      {"velocity_gain", of_sensor<&Sensor::velocity_gain>, Number{sensor_gain_range},
       sensor.velocity_gain,
       "sliding velocity read over the true one; -1: wired backwards, 0: dead"},
      {"velocity_bits", of_sensor<&Sensor::velocity_bits>, Integer{4, 32, "bits"}, Rule{"ideal"},
       "resolution of the converter of the sliding velocity, which spans ± the vibration velocity at full drive or, with an "
       "observed vibration, ± that of the vibration sensor"},
      {"seed", of_sensor<&Sensor::seed>, Integer{0, std::numeric_limits<std::int64_t>::max()},
       static_cast<double>(sensor.seed), "seed of the noise; the same seed gives the same noise"},
      {"vibration", choice<scene::vibration_sensors, &scene::Scene::sensor, &Sensor::vibration>(),
       Word{words_of(scene::vibration_sensors)},
       Rule{"required with resonant; with damped the mode is estimated from the friction force"},
       "sensor of the vibration, read once per carrier period: a pick-up of its velocity, or with "
       "[transducer] its current less that of its clamped capacitance",
       uses::observed_vibration},
      {"vibration_bits", of_sensor<&Sensor::vibration_bits>, Integer{4, 32, "bits"}, Rule{"ideal"},
       "resolution of the vibration converters, one in phase with the drive and one in quadrature",
       seen},
      {"vibration_noise_m_per_s", of_sensor<&Sensor::vibration_noise_m_per_s>,
       Number{{0.0, largest_speed_m_per_s, "m/s"}}, sensor.vibration_noise_m_per_s,
       "noise of each vibration sample, rms, in phase and in quadrature alike", seen},
      {"vibration_full_scale_m_per_s", of_sensor<&Sensor::vibration_full_scale_m_per_s>,
       Number{{1e-12, largest_speed_m_per_s, "m/s"}},
       Rule{"resonant: four times the velocity of the lowest target; damped: of full drive; or of "
            "the fastest sliding if that is larger"},
       "largest vibration velocity that the converters read, in both directions", seen},
  };
}

std::vector<Key> model_error_keys() {
  using scene::ModelError;
  constexpr Number quotient{{0.01, 100.0}};
  const ModelError error;
  const Uses& observed = uses::observed_vibration;
  return {
      {"mass", of_model_error<&ModelError::mass>, quotient, error.mass,
       "nominal over true plant.mass_kg"},
      {"stiffness", of_model_error<&ModelError::stiffness>, quotient, error.stiffness,
       "nominal over true plant.stiffness_N_per_m"},
      {"coefficient", of_model_error<&ModelError::coefficient>, quotient, error.coefficient,
       "nominal over true friction.coefficient"},
      {"contact_stiffness", of_model_error<&ModelError::contact_stiffness>, quotient,
       error.contact_stiffness, "nominal over true friction.contact_stiffness_N_per_m",
       uses::law(scene::is_elastic)},
      {"force_factor", of_model_error<&ModelError::force_factor>, quotient, error.force_factor,
       "nominal over true transducer.force_factor_N_per_V", observed + uses::a_transducer},
      {"damping", of_model_error<&ModelError::damping>, quotient, error.damping,
       "nominal over true plant.damping_N_s_per_m", observed},
  };
}

}  // namespace sonoglide::scene_file
