#include <fmt/format.h>

#include <string>
#include <vector>

#include "host_sim/scene/friction_laws.hpp"
#include "host_sim/scene/names.hpp"
#include "host_sim/scene/solver_facts.hpp"
#include "host_sim/scene/solver_methods.hpp"
#include "host_sim/scene_file/key.hpp"
#include "host_sim/scene_file/keys.hpp"
#include "host_sim/scene_file/law_keys.hpp"
#include "host_sim/scene_file/member.hpp"
#include "host_sim/scene_file/uses.hpp"

// What acts on the mass: plant, friction, sliding, load, transducer and drive.

namespace sonoglide::scene_file {
namespace {

constexpr Range stiffness_range{0.0, 1e18, "N/m"};
constexpr Range coefficient_range{0.0, 100.0};
constexpr Range normal_force_range{0.0, 1e9, "N"};
constexpr Range voltage_range{0.0, 1e9, "V"};
constexpr Range least_force_range{1e-12, largest_force_N, "N"};

/// Without a bound in proportion to Fc a law does not pass into no friction: a profile keeps above 0.
Range profile_range(Range range, const scene::Scene& scene) {
  range.low_open = !scene::is_bounded(scene.friction.law);
  return range;
}

Range initial_force_range(const scene::Scene& scene) {
  const double limit_N = scene.friction.limit_N();
  return {-limit_N, limit_N, "N"};
}

}  // namespace

std::vector<Key> plant_keys() {
  using scene::Plant;
  const Plant plant;
  return {
      {"mass_kg", of_plant<&Plant::mass_kg>, Number{{1e-12, 1e6, "kg"}}, Required{},
       "mass that vibrates"},
      {"stiffness_N_per_m",
       of_plant<&Plant::stiffness_N_per_m>,
       Number{stiffness_range},
       Instead{"stiffness_profile"},
       "stiffness of the spring that holds the mass",
       uses::always,
       {"stiffness_profile"}},
      {"stiffness_profile",
       InPlaceOf{of_plant<&Plant::stiffness_N_per_m>, of_plant<&Plant::stiffness_profile>},
       Profile{time_range, stiffness_range}, Instead{"stiffness_N_per_m"},
       "the same over time, linear between the pairs; two pairs at the same time are a jump"},
      {"damping_N_s_per_m", of_plant<&Plant::damping_N_s_per_m>, Number{{0.0, 1e12, "N s/m"}},
       plant.damping_N_s_per_m,
       "viscous damping of the vibration; above 0 with controller.vibration = \"resonant\""},
      {"initial_displacement_m", of_plant<&Plant::initial_displacement_m>, Number{{-1e3, 1e3, "m"}},
       plant.initial_displacement_m, "displacement at 0 s", uses::given_start},
      {"initial_velocity_m_per_s", of_plant<&Plant::initial_velocity_m_per_s>, Number{speed_range},
       plant.initial_velocity_m_per_s, "vibration velocity at 0 s", uses::given_start},
  };
}

std::vector<Key> friction_keys() {
  using scene::Friction;
  const Uses with_friction = uses::law(uses::has_friction);
  const Uses elastic = uses::law(scene::is_elastic);
  const std::string unbounded =
      uses::laws_where([](const scene::FrictionLaw& law) { return !scene::is_bounded(law); });
  const double largest_limit_N = coefficient_range.high * normal_force_range.high;
  std::vector<Key> keys = {
      {"law", choice<scene::friction_laws, &scene::Scene::friction, &Friction::law>(),
       Word{words_of(scene::friction_laws)}, Required{}, "friction law"},
      {"coefficient",
       of_friction<&Friction::coefficient>,
       Number{coefficient_range},
       Rule{"required, or coefficient_profile"},
       "friction coefficient",
       with_friction,
       {"coefficient_profile"}},
      {"coefficient_profile",
       InPlaceOf{of_friction<&Friction::coefficient>, of_friction<&Friction::coefficient_profile>},
       Profile{time_range, coefficient_range,
               [](const scene::Scene& scene) { return profile_range(coefficient_range, scene); }},
       Rule{"coefficient, constant"},
       fmt::format("friction coefficient over time, in place of coefficient, linear between the "
                   "pairs; two pairs at the same time are a jump; above 0 with {}",
                   unbounded),
       with_friction},
      {"normal_force_N",
       of_friction<&Friction::normal_force_N>,
       Number{normal_force_range},
       Rule{fmt::format("plant.mass_kg * {}", standard_gravity_m_per_s2),
            [](const scene::Scene& scene) {
              return std::optional(scene.plant.mass_kg * standard_gravity_m_per_s2);
            }},
       "normal force of the contact",
       with_friction,
       {"normal_force_profile_N"}},
      {"normal_force_profile_N",
       InPlaceOf{of_friction<&Friction::normal_force_N>,
                 of_friction<&Friction::normal_force_profile_N>},
       Profile{time_range, normal_force_range,
               [](const scene::Scene& scene) { return profile_range(normal_force_range, scene); }},
       Rule{"normal_force_N, constant"},
       fmt::format("normal force over time, in place of normal_force_N, linear between the pairs; "
                   "two pairs at the same time are a jump; above 0 with {}",
                   unbounded),
       with_friction},
      {"contact_stiffness_N_per_m", of_friction<&Friction::contact_stiffness_N_per_m>,
       Number{{1e-6, 1e18, "N/m"}}, Required{}, "tangential stiffness of the contact", elastic},
      {"initial_force_N", of_friction<&Friction::initial_force_N>,
       Number{{-largest_limit_N, largest_limit_N, "N"}, initial_force_range},
       scene::ContactValues{}.initial_force_N,
       "friction force at 0 s; its magnitude is at most coefficient * normal_force_N",
       elastic + uses::given_start},
      {"sign_convention",
       choice<scene::sign_conventions, &scene::Scene::friction, &Friction::sign_convention>(),
       Word{words_of(scene::sign_conventions)},
       scene::name_of(scene::sign_conventions, scene::ContactValues{}.sign_convention),
       "dissipative: the contact slides at Vt + x'; as_printed: at Vt - x', as in the paper's "
       "equations (1) and (2)",
       uses::law([](const scene::FrictionLaw& law) {
         return uses::has_friction(law) && scene::vibrates_along(law);
       })},
  };
  add_law_keys(keys);
  return keys;
}

std::vector<Key> sliding_keys() {
  constexpr auto* points = of<&scene::Scene::sliding, &scene::Sliding::profile>;
  return {
      {"velocity_m_per_s",
       ConstantSpeed{points},
       Number{speed_range},
       Instead{"profile"},
       "constant sliding velocity Vt",
       uses::always,
       {"profile"}},
      {"profile", points, Profile{time_range, speed_range}, Instead{"velocity_m_per_s"},
       "sliding velocity over time, linear between the pairs, constant before and after them"},
  };
}

std::vector<Key> load_keys() {
  using scene::Load;
  const Load load;
  constexpr Range applied_range{-largest_force_N, largest_force_N, "N"};
  return {
      {"mass_kg", of_load<&Load::mass_kg>, Number{{1e-12, 1e9, "kg"}}, Required{},
       "mass of the body that slides"},
      {"damping_N_s_per_m", of_load<&Load::damping_N_s_per_m>, Number{{0.0, 1e12, "N s/m"}},
       load.damping_N_s_per_m, "viscous damping of its motion"},
      {"initial_velocity_m_per_s", of_load<&Load::initial_velocity_m_per_s>, Number{speed_range},
       load.initial_velocity_m_per_s, "its velocity at 0 s, where its displacement is 0"},
      {"force_profile_N", of_load<&Load::force_profile_N>, Profile{time_range, applied_range},
       Rule{"no force"},
       "force on it over time, linear between the pairs; two pairs at the same time are a jump"},
      {"spring_N_per_m", of_load<&Load::spring_N_per_m>, Number{stiffness_range},
       load.spring_N_per_m, "stiffness of a spring at it, not stretched at 0 s"},
      {"pull_profile_m_per_s", of_load<&Load::pull_profile_m_per_s>,
       Profile{time_range, speed_range}, Rule{"it stands"},
       "velocity of the far end of the spring over time, linear between the pairs",
       uses::a_load_spring},
  };
}

std::vector<Key> transducer_keys() {
  using scene::Transducer;
  return {
      {"force_factor_N_per_V", of_transducer<&Transducer::force_factor_N_per_V>,
       Number{{1e-12, 1e12, "N/V"}}, Required{}, "force on the mass over the voltage"},
      {"clamped_capacitance_F", of_transducer<&Transducer::clamped_capacitance_F>,
       Number{{0.0, 1.0, "F"}}, Required{}, "capacitance while the mass is held"},
      {"loss_tangent", of_transducer<&Transducer::loss_tangent>, Number{{0.0, 10.0}},
       Transducer{}.loss_tangent,
       "dielectric losses of this capacitance: active over reactive current"},
  };
}

std::vector<Key> drive_keys() {
  using scene::Drive;
  const Drive drive;
  const Uses open_loop = uses::open_loop("in closed loop: the controller sets the amplitude");
  const Uses& closed_loop = uses::closed_loop;
  return {
      {"frequency_Hz", of_drive<&Drive::frequency_Hz>, Number{frequency_range}, Required{},
       "carrier frequency; with frequency_profile only the unit of the keys in carrier periods; "
       "with controller.vibration = \"resonant\" that of the first periods, before the nominal "
       "natural frequency"},
      {"frequency_profile", of_drive<&Drive::frequency_profile>,
       Profile{time_range, frequency_range}, Rule{"frequency_Hz, constant"},
       "carrier frequency over time, linear between the pairs; a carrier period has that of its "
       "beginning",
       open_loop},
      {"frequency_resolution_Hz", OrZero{of_drive<&Drive::frequency_resolution_Hz>},
       Number{{0.0, 1e9, "Hz"}}, drive.frequency_resolution_Hz,
       "step of the frequency word: the drive has the nearest multiple of it; 0: any frequency"},
      {"force_amplitude_N", of_drive<&Drive::force_amplitude_N>, Number{force_range},
       Instead{"max_force_amplitude_N"}, "amplitude of the drive force",
       open_loop + uses::in_newtons},
      {"voltage_amplitude_V", of_drive<&Drive::voltage_amplitude_V>, Number{voltage_range},
       Instead{"max_voltage_amplitude_V"}, "amplitude of the drive voltage",
       open_loop + uses::in_volts},
      {"waveform", choice<scene::waveforms, &scene::Scene::drive, &Drive::waveform>(),
       Word{words_of(scene::waveforms)}, scene::name_of(scene::waveforms, drive.waveform),
       fmt::format(
           "shape of the drive force, with its peak at phase 0, where the positive half of a "
           "square begins; a shape other than cosine is not for a [transducer], and needs {}",
           uses::methods_where(scene::follows_straight_drives))},
      {"max_force_amplitude_N", of_drive<&Drive::max_force_amplitude_N>, Number{least_force_range},
       Instead{"force_amplitude_N"}, "limit of the actuator: largest amplitude of the drive force",
       closed_loop + uses::in_newtons},
      {"max_voltage_amplitude_V", of_drive<&Drive::max_voltage_amplitude_V>,
       Number{{1e-12, voltage_range.high, "V"}}, Instead{"voltage_amplitude_V"},
       "limit of the amplifier: largest amplitude of the voltage", closed_loop + uses::in_volts},
      {"max_current_amplitude_A", of_drive<&Drive::max_current_amplitude_A>,
       Number{{1e-12, 1e9, "A"}}, Rule{"no limit"},
       "limit of the amplifier: largest amplitude of the current's fundamental",
       uses::implied(uses::a_transducer) + uses::implied(closed_loop) +
           uses::resonance(uses::not_at_resonance)},
      {"max_force_slew_N_per_s", of_drive<&Drive::max_force_slew_N_per_s>,
       Number{{1e-12, 1e21, "N/s"}}, Rule{"no limit"},
       "limit of the actuator: fastest change of the amplitude from one carrier period to the next",
       closed_loop + uses::in_newtons + uses::no_damped_vibration},
      {"delay_periods", of_drive<&Drive::delay_periods>, Integer{0, 16, "periods"},
       static_cast<double>(drive.delay_periods),
       "carrier periods from the end of a sampled period to the phase 0 at which the command that "
       "answers it acts; 0: a board that computes in no time",
       closed_loop},
      {"bits", of_drive<&Drive::bits>, Integer{4, 31, "bits"}, Rule{"as fine as the arithmetic"},
       "resolution of the actuator: the amplitude is the nearest of as many equal parts of its limit as a number "
       "of so many bits tells apart",
       closed_loop},
      {"interpolation",
       choice<scene::interpolations, &scene::Scene::drive, &Drive::interpolation>(),
       Word{words_of(scene::interpolations)},
       scene::name_of(scene::interpolations, drive.interpolation),
       "how the amplitude passes from one carrier period to the next. step: at once, at phase 0. "
       "linear: along a straight line over the period that begins there, which pays off where the "
       "stiffness is uncertain and the natural mode near a multiple of the carrier",
       closed_loop + uses::cosine_drive},
      {"codes_per_period", of_drive<&Drive::codes_per_period>, Integer{1, 8},
       static_cast<double>(drive.codes_per_period),
       "amplitudes that the actuator takes in a carrier period: 1, 2, 4 or 8. 1: the line itself; "
       "more: a staircase of as many equal parts, each with the amplitude of the line in its "
       "middle",
       closed_loop + uses::linear_interpolation},
      {"bias_limit_N", OrZero{of_drive<&Drive::bias_limit_N>}, Number{force_range},
       drive.bias_limit_N,
       "limit of the actuator: largest force that is constant over a carrier period, beside the "
       "carrier; 0: none. Above 0 the controller takes the friction from a slow natural mode by it, "
       "and with controller.vibration damps it, see firmware/control/vibration.md",
       closed_loop + uses::cosine_drive + uses::no_transducer + uses::no_resonance},
  };
}

}  // namespace sonoglide::scene_file
