#include "host_sim/scene_file/keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <deque>
#include <limits>
#include <stdexcept>
#include <utility>

#include "host_sim/configure/bound.hpp"
#include "host_sim/configure/solver_facts.hpp"
#include "host_sim/configure/solver_methods.hpp"
#include "host_sim/scene/friction_laws.hpp"
#include "host_sim/scene/names.hpp"

namespace sonoglide::scene_file {

std::string Range::text() const {
  const std::string bounds =
      fmt::format(fmt::runtime(low_open ? "above {}, at most {}" : "{} to {}"),
                  configure::at_least(low), configure::at_most(high));
  return unit.empty() ? bounds : fmt::format("{} {}", bounds, unit);
}

namespace {

constexpr double largest_force_N = 1e12;
constexpr double largest_speed_m_per_s = 1e6;
constexpr Range time_range{0.0, 1e9, "s"};
constexpr Range speed_range{-largest_speed_m_per_s, largest_speed_m_per_s, "m/s"};
constexpr Range force_range{0.0, largest_force_N, "N"};
constexpr Range stiffness_range{0.0, 1e18, "N/m"};
constexpr Range frequency_range{1e-3, 1e9, "Hz"};
constexpr double largest_voltage_V = 1e9;
constexpr Range either_force_range{-largest_force_N, largest_force_N, "N"};
constexpr Range sensor_gain_range{-100.0, 100.0};
constexpr Range coefficient_range{0.0, 100.0};
constexpr Range normal_force_range{0.0, 1e9, "N"};

const char* const open_loop = "open loop";
const char* const closed_loop_only = "closed loop";
const char* const open_loop_volts = "open loop with [transducer]";
const char* const closed_loop_volts = "closed loop with [transducer]";
const char* const at_resonance = "controller.vibration = \"resonant\"";
const char* const observed = "controller.vibration";
const char* const seen_vibration = "sensor.vibration";
const char* const observed_volts = "controller.vibration with [transducer]";
const char* const fed_forward = "without controller.vibration";
const char* const with_robust_notch = "controller.shaping = \"robust\"";
const char* const with_force = "sensor.force = true";

template <class Value, std::size_t Count>
Words words_of(const std::array<scene::Named<Value>, Count>& names) {
  Words words;
  for (const scene::Named<Value>& each : names) {
    words.push_back(each.name);
  }
  return words;
}

/// The laws for which `holds(law)`.
template <class Condition>
std::string laws_where(const Condition& holds) {
  Words words;
  Words others;
  for (const scene::FrictionLaw& law : scene::every_law) {
    (holds(law) ? words : others).push_back(scene::name_of(law));
  }
  if (others.size() == 1) {
    return fmt::format("every law but {}", others.front());
  }
  return fmt::format("law {}", fmt::join(words, ", "));
}

/// The methods for which `holds(described)`.
template <class Condition>
std::string methods_where(const Condition& holds) {
  Words words;
  configure::for_each_solver([&](auto described, scene::SolverMethod /*method*/) {
    if (holds(described)) {
      words.push_back(decltype(described)::name);
    }
  });
  return fmt::format("method {}", fmt::join(words, ", "));
}

bool has_friction(const scene::FrictionLaw& law) {
  return !scene::is<scene::laws::None>(law);
}

std::vector<Key> plant_keys() {
  const scene::Plant plant;
  return {
      {"mass_kg", Number{{1e-12, 1e6, "kg"}}, Required{}, "mass that vibrates"},
      {"stiffness_N_per_m", Number{stiffness_range}, Instead{"stiffness_profile"},
       "stiffness of the spring that holds the mass"},
      {"stiffness_profile", Profile{time_range, stiffness_range}, Instead{"stiffness_N_per_m"},
       "the same over time, linear between the pairs; two pairs at the same time are a jump"},
      {"damping_N_s_per_m", Number{{0.0, 1e12, "N s/m"}}, plant.damping_N_s_per_m,
       "viscous damping of the vibration; above 0 with controller.vibration = \"resonant\""},
      {"initial_displacement_m", Number{{-1e3, 1e3, "m"}}, plant.initial_displacement_m,
       "displacement at 0 s", "run.start = \"given\""},
      {"initial_velocity_m_per_s", Number{speed_range}, plant.initial_velocity_m_per_s,
       "vibration velocity at 0 s", "run.start = \"given\""},
  };
}

/// Those of every law.
std::vector<Key> friction_keys() {
  const std::string with_friction = laws_where(has_friction);
  const std::string elastic = laws_where(scene::is_elastic);
  const std::string unbounded =
      laws_where([](const scene::FrictionLaw& law) { return !scene::is_bounded(law); });
  const double largest_limit_N = coefficient_range.high * normal_force_range.high;
  std::vector<Key> keys = {
      {"law", Word{words_of(scene::friction_laws)}, Required{}, "friction law"},
      {"coefficient", Number{coefficient_range}, Rule{"required, or coefficient_profile"},
       "friction coefficient", with_friction},
      {"coefficient_profile", Profile{time_range, coefficient_range}, Rule{"coefficient, constant"},
       fmt::format("friction coefficient over time, in place of coefficient, linear between the "
                   "pairs; two pairs at the same time are a jump; above 0 with {}",
                   unbounded),
       with_friction},
      {"normal_force_N", Number{normal_force_range},
       Rule{fmt::format("plant.mass_kg * {}", standard_gravity_m_per_s2)},
       "normal force of the contact", with_friction},
      {"normal_force_profile_N", Profile{time_range, normal_force_range},
       Rule{"normal_force_N, constant"},
       fmt::format("normal force over time, in place of normal_force_N, linear between the pairs; "
                   "two pairs at the same time are a jump; above 0 with {}",
                   unbounded),
       with_friction},
      {"contact_stiffness_N_per_m", Number{{1e-6, 1e18, "N/m"}}, Required{},
       "tangential stiffness of the contact", elastic},
      {"initial_force_N", Number{{-largest_limit_N, largest_limit_N, "N"}},
       scene::ContactValues{}.initial_force_N,
       "friction force at 0 s; its magnitude is at most coefficient * normal_force_N",
       elastic + "; run.start = \"given\""},
      {"sign_convention", Word{words_of(scene::sign_conventions)},
       scene::name_of(scene::sign_conventions, scene::ContactValues{}.sign_convention),
       "dissipative: the contact slides at Vt + x'; as_printed: at Vt - x', as in the paper's "
       "equations (1) and (2)",
       laws_where([](const scene::FrictionLaw& law) {
         return has_friction(law) && scene::vibrates_along(law);
       })},
  };
  add_law_keys(keys);
  return keys;
}

std::vector<Key> sliding_keys() {
  return {
      {"velocity_m_per_s", Number{speed_range}, Instead{"profile"}, "constant sliding velocity Vt"},
      {"profile", Profile{time_range, speed_range}, Instead{"velocity_m_per_s"},
       "sliding velocity over time, linear between the pairs, constant before and after them"},
  };
}

std::vector<Key> transducer_keys() {
  const scene::Transducer transducer;
  return {
      {"force_factor_N_per_V", Number{{1e-12, 1e12, "N/V"}}, Required{},
       "force on the mass over the voltage"},
      {"clamped_capacitance_F", Number{{0.0, 1.0, "F"}}, Required{},
       "capacitance while the mass is held"},
      {"loss_tangent", Number{{0.0, 10.0}}, transducer.loss_tangent,
       "dielectric losses of this capacitance: active over reactive current"},
  };
}

std::vector<Key> drive_keys() {
  const scene::Drive drive;
  return {
      {"frequency_Hz", Number{frequency_range}, Required{},
       "carrier frequency; with frequency_profile only the unit of the keys in carrier periods; "
       "with controller.vibration = \"resonant\" that of the first periods, before the believed "
       "natural frequency"},
      {"frequency_profile", Profile{time_range, frequency_range}, Rule{"frequency_Hz, constant"},
       "carrier frequency over time, linear between the pairs; a carrier period has that of its "
       "beginning",
       open_loop},
      {"frequency_resolution_Hz", Number{{0.0, 1e9, "Hz"}}, drive.frequency_resolution_Hz,
       "step of the frequency word: the drive has the nearest multiple of it; 0: any frequency"},
      {"force_amplitude_N", Number{force_range}, Instead{"max_force_amplitude_N"},
       "amplitude of the drive force", "open loop without [transducer]"},
      {"voltage_amplitude_V", Number{{0.0, largest_voltage_V, "V"}},
       Instead{"max_voltage_amplitude_V"}, "amplitude of the drive voltage", open_loop_volts},
      {"waveform", Word{words_of(scene::waveforms)},
       scene::name_of(scene::waveforms, drive.waveform),
       fmt::format("shape of the drive force, with its peak at phase 0; a shape other than cosine "
                   "needs {}",
                   methods_where([](auto described) {
                     return !decltype(described)::straight_orders.empty();
                   }))},
      {"max_force_amplitude_N", Number{{1e-12, largest_force_N, "N"}}, Instead{"force_amplitude_N"},
       "limit of the actuator: largest amplitude of the drive force",
       "closed loop without [transducer]"},
      {"max_voltage_amplitude_V", Number{{1e-12, largest_voltage_V, "V"}},
       Instead{"voltage_amplitude_V"}, "limit of the amplifier: largest amplitude of the voltage",
       closed_loop_volts},
      {"max_current_amplitude_A", Number{{1e-12, 1e9, "A"}}, Rule{"no limit"},
       "limit of the amplifier: largest amplitude of the current's fundamental", at_resonance},
      {"max_force_slew_N_per_s", Number{{1e-12, 1e21, "N/s"}}, Rule{"no limit"},
       "limit of the actuator: fastest change of the amplitude",
       "closed loop without [transducer]"},
      {"delay_periods", Integer{0, 16, "periods"}, static_cast<double>(drive.delay_periods),
       "carrier periods from the end of a sampled period to the phase 0 at which the command that "
       "answers it acts; 0 stands for a board that computes in no time",
       closed_loop_only},
  };
}

std::string default_tolerances() {
  std::string words;
  configure::for_each_solver([&](auto described, scene::SolverMethod /*method*/) {
    using Described = decltype(described);
    if constexpr (Described::adaptive) {
      words += fmt::format("{}{} with {}", words.empty() ? "" : ", ", Described::default_tolerance,
                           Described::name);
    }
  });
  return words;
}

std::string built_orders() {
  std::string words;
  configure::for_each_solver([&](auto described, scene::SolverMethod /*method*/) {
    using Described = decltype(described);
    if constexpr (Described::takes_order) {
      words += fmt::format("{}{} with {}", words.empty() ? "" : "; ",
                           fmt::join(Described::orders, ", "), Described::name);
    }
  });
  return words;
}

/// Adaptive, with a longest step that a scene may give.
template <class Described>
constexpr bool takes_longest_step() {
  if constexpr (Described::adaptive) {
    return Described::takes_step;
  } else {
    return false;
  }
}

std::vector<Key> solver_keys() {
  const auto is_adaptive = [](auto described) { return decltype(described)::adaptive; };
  const auto takes_order = [](auto described) { return decltype(described)::takes_order; };
  const auto takes_longest = [](auto described) {
    return takes_longest_step<decltype(described)>();
  };
  const auto takes_step = [](auto described) {
    using Described = decltype(described);
    return !Described::adaptive || takes_longest_step<Described>();
  };
  return {
      {"method", Word{words_of(configure::solver_methods)},
       configure::name_of(scene::SolverMethod{}), "solver"},
      {"tolerance", Number{{1e-15, 1e-2}}, Rule{default_tolerances()},
       "event_taylor, event_gauss: error of the friction ratio over a hundred carrier periods that "
       "the method aims at; strang: limit of the defects of velocity and energy in each step",
       methods_where(is_adaptive)},
      {"order", Integer{1, 99}, Rule{"the one that suits the tolerance"},
       fmt::format("order of the method, one of those that are built: {}", built_orders()),
       methods_where(takes_order)},
      {"step_s", Number{{1e-15, 1.0, "s"}},
       Rule{fmt::format("required; no limit with {}", methods_where(takes_longest))},
       fmt::format("length of the steps, shortened so that a whole number of them fills a carrier "
                   "period; the longest step with {}",
                   methods_where(takes_longest)),
       methods_where(takes_step)},
  };
}

std::vector<Key> run_keys() {
  const scene::Run run;
  return {
      {"start", Word{words_of(scene::starts)}, scene::name_of(scene::starts, run.start),
       "given: from the initial state; steady: on the periodic orbit, for which drive, sliding and "
       "friction must be constant",
       open_loop},
      {"duration_s", Number{{1e-12, 1e9, "s"}}, Instead{"duration_periods"}, "simulated time"},
      {"duration_periods", Number{{1e-3, most_periods, "periods"}}, Instead{"duration_s"},
       "simulated time in carrier periods", "[drive]"},
      {"window_start_s", Number{time_range}, run.window_start_s,
       "start of the window over which means are taken; the window ends with the run"},
      {"window_start_periods", Number{{0.0, most_periods, "periods"}}, Rule{"window_start_s"},
       "the same in carrier periods, in place of window_start_s", "[drive]"},
      {"settling_band", Number{{0.0, 1.0, "", true}}, run.settling_band,
       "half width of the band around a target, in friction ratio; a step has settled once the "
       "ratio stays in the band, at least for the last tenth of the step",
       closed_loop_only},
      {"record", WordList{words_of(scene::channels)}, Rule{"nothing is recorded"},
       "channels that trace.csv records"},
      {"record_interval_s", Number{{1e-15, 1e9, "s"}}, Rule{"required if record names a channel"},
       "time between two rows of trace.csv", "run.record"},
  };
}

std::vector<Key> controller_keys() {
  const scene::Controller controller;
  return {
      {"arithmetic", Word{words_of(scene::arithmetics)}, Required{},
       "number type in which the controller computes; not q15 with controller.vibration"},
      {"vibration", Word{words_of(scene::vibration_controls)},
       Rule{"the drive is fed forward, at a fixed frequency"},
       "resonant: the controller observes the vibration, follows the plant's resonance with the "
       "frequency of the drive and holds the vibration velocity; needs [transducer]. damped: the "
       "same at a fixed frequency off resonance, with the natural mode damped by feedback: as "
       "sensor.vibration sees it, or without one as the friction shows it",
       closed_loop_only},
      {"frequency_range_Hz", Interval{frequency_range},
       Rule{"5 % below to 5 % above drive.frequency_Hz"},
       "lowest and highest frequency of the drive, below and above drive.frequency_Hz, within 6 % "
       "of it",
       at_resonance},
      {"target_friction_ratio", Profile{time_range, {0.0, 1.0, "", true}}, Required{},
       "target friction ratio, constant from each time to the next; the first time is 0"},
      {"calibration_s", Number{time_range},
       Rule{
           "0; where the vibration is felt in the friction, as long as a contact half as stiff as "
           "believed and the sensor take to settle, at most half of the first target's time, and 0 "
           "where that is too short"},
       "time with the drive off in which the friction force is learnt; 0: the controller believes "
       "the scene's",
       with_force},
      {"shaping", Word{words_of(scene::shapings)},
       scene::name_of(scene::shapings, controller.shaping),
       "filter between target and drive. notch: cancels the ringing of the natural mode. robust: "
       "the same for a mode that is only known within shaping_range",
       fed_forward},
      {"shaping_range", Number{{scene::least_shaping_range, scene::most_shaping_range}},
       Rule{"as far as the tolerances of stiffness and mass go; without these 0.1, for a stiffness "
            "that is 20 % off"},
       "how far the natural frequency may be off, relative to the believed one; the robust notch "
       "has its zeros in this range",
       with_robust_notch},
      {"speed_floor_m_per_s", Number{{1e-12, largest_speed_m_per_s, "m/s"}},
       Rule{
           "velocity at which the presliding distance takes three carrier periods; at most half of "
           "the fastest sliding and of the largest vibration velocity"},
       "sliding velocity below which the drive is held"},
      {"standstill_hold_s", Number{time_range}, controller.standstill_hold_s,
       "time for which the drive is held below the speed floor before it falls to 0"},
      {"relearn_every_s", Number{{1e-9, 1e9, "s"}}, Rule{"never"},
       "time between two pauses of the drive in which the friction force is learnt again",
       with_force},
      {"mismatch_warning", Number{{1.01, 100.0}}, controller.mismatch_warning,
       "the limit mismatch is reported once believed over true friction, or its inverse, reaches "
       "this value",
       with_force},
  };
}

std::vector<Key> sensor_keys() {
  const scene::Sensor sensor;
  return {
      {"force", Truth{}, Rule{"true"},
       "whether there is a sensor of the friction force; false: the ratio is held by the vibration "
       "alone, and rests on the friction that the controller believes",
       observed},
      {"adc_bits", Integer{4, 32, "bits"}, Rule{"ideal"}, "resolution of the force converter",
       with_force},
      {"force_full_scale_N", Number{{1e-15, largest_force_N, "N"}},
       Rule{"2 * coefficient * normal_force_N, of profiles the largest"},
       "largest force that the converter reads, in both directions", with_force},
      {"force_noise_N", Number{force_range}, sensor.force_noise_N,
       "noise of each sample of the force, rms", with_force},
      {"force_bandwidth_Hz", Number{{1e-3, 1e12, "Hz"}}, Rule{"no limit"},
       "bandwidth of the force sensor, a low-pass of first order", with_force},
      {"delay_periods", Integer{0, 64, "periods"}, static_cast<double>(sensor.delay_periods),
       "carrier periods by which the force reading is late", with_force},
      {"force_offset_N", Number{either_force_range}, sensor.force_offset_N,
       "force read while the true force is 0", with_force},
      {"force_gain", Number{sensor_gain_range}, sensor.force_gain,
       "force read over true force; -1: wired backwards, 0: dead", with_force},
      {"velocity_offset_m_per_s", Number{speed_range}, sensor.velocity_offset_m_per_s,
       "sliding velocity read at standstill"},
      {"velocity_gain", Number{sensor_gain_range}, sensor.velocity_gain,
       "sliding velocity read over the true one; -1: wired backwards, 0: dead"},
      {"seed", Integer{0, std::numeric_limits<std::int64_t>::max()},
       static_cast<double>(sensor.seed), "seed of the noise; the same seed gives the same noise"},
      {"vibration", Word{words_of(scene::vibration_sensors)},
       Rule{"required with resonant; with damped the vibration is felt in the friction"},
       "what the vibration is seen by, once per carrier period: a pick-up of its velocity, or the "
       "current of the transducer less that of its clamped capacitance, with [transducer]",
       observed},
      {"vibration_bits", Integer{4, 32, "bits"}, Rule{"ideal"},
       "resolution of the vibration converters, one in phase with the drive and one in quadrature",
       seen_vibration},
      {"vibration_noise_m_per_s", Number{{0.0, largest_speed_m_per_s, "m/s"}},
       sensor.vibration_noise_m_per_s,
       "noise of each vibration sample, rms, in phase and in quadrature alike", seen_vibration},
      {"vibration_full_scale_m_per_s", Number{{1e-12, largest_speed_m_per_s, "m/s"}},
       Rule{"resonant: four times the velocity of the lowest target; damped: of full drive; or of "
            "the fastest sliding if that is larger"},
       "largest vibration velocity that the converters read, in both directions", seen_vibration},
  };
}

std::vector<Key> model_error_keys() {
  constexpr Range quotient{0.01, 100.0};
  const scene::ModelError model_error;
  return {
      {"mass", Number{quotient}, model_error.mass, "believed over true plant.mass_kg"},
      {"stiffness", Number{quotient}, model_error.stiffness,
       "believed over true plant.stiffness_N_per_m"},
      {"coefficient", Number{quotient}, model_error.coefficient,
       "believed over true friction.coefficient"},
      {"contact_stiffness", Number{quotient}, model_error.contact_stiffness,
       "believed over true friction.contact_stiffness_N_per_m", laws_where(scene::is_elastic)},
      {"force_factor", Number{quotient}, model_error.force_factor,
       "believed over true transducer.force_factor_N_per_V", observed_volts},
      {"damping", Number{quotient}, model_error.damping,
       "believed over true plant.damping_N_s_per_m", observed},
  };
}

std::string_view unit_in(const Allowed& allowed) {
  if (const auto* number = std::get_if<Number>(&allowed)) {
    return number->range.unit;
  }
  if (const auto* integer = std::get_if<Integer>(&allowed)) {
    return integer->unit;
  }
  if (const auto* interval = std::get_if<Interval>(&allowed)) {
    return interval->range.unit;
  }
  if (const auto* spread = std::get_if<Spread>(&allowed)) {
    return spread->range.unit;
  }
  const auto* profile = std::get_if<Profile>(&allowed);
  return profile != nullptr ? profile->value.unit : "";
}

std::vector<KeyTable> plain_tables() {
  return {
      {"plant", true, "the mass that vibrates, on a spring and a damper", plant_keys()},
      {"friction", true, "the contact and its friction law", friction_keys()},
      {"sliding", true, "how the body slides over the contact", sliding_keys()},
      {"transducer", false,
       "the piezo transducer between amplifier and mass; without this table the drive is a force",
       transducer_keys()},
      {"drive", false, "the force that drives the vibration; needed in closed loop", drive_keys()},
      {"solver", false, "how the motion is computed", solver_keys()},
      {"run", true, "how long to simulate and what to record", run_keys()},
      {"controller", false,
       "the controller of the friction ratio; a scene with this table runs in closed loop, without "
       "it in open loop",
       controller_keys()},
      {"sensor", false, "errors of the sensors, in closed loop; ideal without this table",
       sensor_keys()},
      {"model_error", false,
       "believed over true value of the parameters that the controller is designed with, in closed "
       "loop; 1 without this table",
       model_error_keys()},
  };
}

/// Of these the controller alone knows: the plant has no other value of them.
constexpr std::array settings = {"drive.frequency_resolution_Hz", "drive.max_current_amplitude_A",
                                 "drive.max_force_slew_N_per_s", "sensor.force_full_scale_N",
                                 "sensor.vibration_full_scale_m_per_s"};

/// An integer that a double holds.
constexpr std::int64_t largest_integer = std::int64_t{1} << 53;

Allowed varied_range(const Allowed& allowed) {
  const auto* integer = std::get_if<Integer>(&allowed);
  return integer == nullptr
             ? allowed
             : Integer{integer->low, std::min(integer->high, largest_integer), integer->unit};
}

/// A number that a plant may have otherwise than its scene says.
struct Variable {
  std::string_view name;  ///< `table.key`; lives for good
  Allowed allowed;        ///< Number or Integer
  std::string used;
};

std::vector<Variable> variables(const std::vector<KeyTable>& tables) {
  static std::deque<std::string> names;
  std::vector<Variable> all;
  for (const KeyTable& table : tables) {
    constexpr std::array varied = {"plant", "friction", "transducer", "drive", "sensor"};
    if (std::find(varied.begin(), varied.end(), table.name) == varied.end()) {
      continue;
    }
    for (const Key& key : table.keys) {
      const bool numeric = std::holds_alternative<Number>(key.allowed) ||
                           std::holds_alternative<Integer>(key.allowed);
      std::string name = fmt::format("{}.{}", table.name, key.name);
      if (numeric && std::find(settings.begin(), settings.end(), name) == settings.end()) {
        names.push_back(std::move(name));
        all.push_back({names.back(), varied_range(key.allowed), key.used});
      }
    }
  }
  return all;
}

Spread spread_of(const Allowed& allowed) {
  if (const auto* number = std::get_if<Number>(&allowed)) {
    return {number->range};
  }
  const auto& integer = std::get<Integer>(allowed);
  return {{static_cast<double>(integer.low), static_cast<double>(integer.high), integer.unit},
          true};
}

void add_tables_of_others(std::vector<KeyTable>& tables) {
  KeyTable tolerance{"tolerance",
                     false,
                     "how far the true value of a number may be from the scene's, which the "
                     "controller believes; for the command robust, every other one takes the scene "
                     "as it is",
                     {},
                     true};
  KeyTable true_values{"true_values",
                       false,
                       "true value of a number where that is known to be another than the scene's, "
                       "which the controller believes; what follows from that number by default "
                       "stays as it is",
                       {},
                       true};
  for (const Variable& each : variables(tables)) {
    tolerance.keys.push_back({each.name, spread_of(each.allowed), Rule{"the scene's value"},
                              fmt::format("true value of {}", each.name), each.used});
    true_values.keys.push_back({each.name, each.allowed, Rule{"the scene's value"},
                                fmt::format("true value of {}", each.name), each.used});
  }
  tables.push_back(std::move(tolerance));
  tables.push_back(std::move(true_values));
}

}  // namespace

const std::vector<KeyTable>& key_tables() {
  static const std::vector<KeyTable> tables = [] {
    std::vector<KeyTable> all = plain_tables();
    add_tables_of_others(all);
    return all;
  }();
  return tables;
}

const KeyTable* find_table(std::string_view name) {
  const auto& tables = key_tables();
  const auto found = std::find_if(tables.begin(), tables.end(),
                                  [&](const KeyTable& table) { return table.name == name; });
  return found == tables.end() ? nullptr : &*found;
}

const Key* find_key(const KeyTable& table, std::string_view name) {
  const auto found = std::find_if(table.keys.begin(), table.keys.end(),
                                  [&](const Key& key) { return key.name == name; });
  return found == table.keys.end() ? nullptr : &*found;
}

const KeyTable& key_table(std::string_view name) {
  if (const KeyTable* table = find_table(name)) {
    return *table;
  }
  throw std::logic_error(fmt::format("no table {} is described", name));
}

const Key& key_of(const KeyTable& table, std::string_view name) {
  if (const Key* key = find_key(table, name)) {
    return *key;
  }
  throw std::logic_error(fmt::format("no key {}.{} is described", table.name, name));
}

std::string_view unit_of(const Key& key) {
  return unit_in(key.allowed);
}

namespace {

/// Adds the keys of one law; a range that follows another key is described at the value 0 of that.
class LawKeys {
 public:
  LawKeys(std::vector<Key>& keys, std::string_view law) : keys_(keys), law_(law) {}

  void required(std::string_view key, double /*parameter*/, const Range& range,
                std::string_view meaning) {
    add({key, Number{range}, Required{}, std::string(meaning)});
  }
  void optional(std::string_view key, double parameter, const Range& range,
                std::string_view meaning) {
    add({key, Number{range}, parameter, std::string(meaning)});
  }
  void optional(std::string_view key, int count, int least, int most, std::string_view meaning) {
    add({key, Integer{least, most}, static_cast<double>(count), std::string(meaning)});
  }
  void refuse(std::string_view /*key*/, double /*parameter*/, std::string_view /*finding*/,
              double /*least*/, std::string_view /*rest*/) {}

 private:
  void add(Key described) {
    const auto known = std::find_if(keys_.begin(), keys_.end(),
                                    [&](const Key& each) { return each.name == described.name; });
    if (known != keys_.end()) {
      known->used += ", " + law_;
      return;
    }
    described.used = "law " + law_;
    keys_.push_back(std::move(described));
  }

  std::vector<Key>& keys_;
  std::string law_;
};

}  // namespace

void add_law_keys(std::vector<Key>& keys) {
  for (scene::FrictionLaw law : scene::every_law) {
    LawKeys own(keys, scene::name_of(law));
    std::visit([&](auto& any) { any.visit_keys(own, scene::ContactValues{}); }, law);
  }
}

}  // namespace sonoglide::scene_file
