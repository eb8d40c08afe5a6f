/// Every composition that a scene can name, of law, damping, drive, sliding and solver, against its
/// equations in SI units by Boost.odeint; what is not composed is refused by the reader.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/loop/plant/carrier_grid.hpp"
#include "host_sim/loop/plant_run.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/scene/cores/solver_cores.hpp"
#include "host_sim/scene/law_cores.hpp"
#include "host_sim/scene/names.hpp"
#include "host_sim/scene/solver_methods.hpp"
#include "tests/common/constants/pi.hpp"
#include "tests/host_sim/loop/equations/follow.hpp"

namespace sonoglide::loop::compositions_test {
namespace {

using tests::two_pi;
constexpr double frequency_Hz = 60e3;
constexpr double period_s = 1.0 / frequency_Hz;
constexpr double duration_s = 5.5e-5;  // 3.3 periods
constexpr double drive_N = 384.0;
constexpr double first_displacement_m = 1e-7;
constexpr double first_velocity_m_per_s = 0.03;

/// Friction bends the motion, the mode is below the carrier, the contact opens under normal
/// vibration.
constexpr equations::Mass undamped_mass = {0.02, 8.5e8, 0.0};
constexpr double damping_N_s_per_m = 300.0;
constexpr equations::Contact every_number_of_a_contact() {
  equations::Contact all{};
  all.coefficient = 0.1;
  all.normal_force_N = 500.0;
  all.contact_stiffness_N_per_m = 1e9;
  all.static_coefficient = 0.13;
  all.stribeck_velocity_m_per_s = 0.02;
  all.bristle_damping_N_s_per_m = 50.0;
  all.viscous_friction_N_s_per_m = 60.0;
  all.fall_s_per_m = 0.8;
  all.rise_s3_per_m3 = 20.0;
  all.normal_contact_stiffness_N_per_m = 4e9;
  all.elements = 3;
  return all;
}
constexpr equations::Contact contact = every_number_of_a_contact();

/// Own keys, beside the coefficient and the normal force.
std::string own_keys(const scene::FrictionLaw& law) {
  const std::string_view name = scene::name_of(law);
  std::string keys;
  if (name == "lugre") {
    keys = fmt::format(
        "static_coefficient = {}\nstribeck_velocity_m_per_s = {}\n"
        "bristle_damping_N_s_per_m = {}\nviscous_friction_N_s_per_m = {}\n",
        contact.static_coefficient, contact.stribeck_velocity_m_per_s,
        contact.bristle_damping_N_s_per_m, contact.viscous_friction_N_s_per_m);
  } else if (name == "iwan") {
    keys = fmt::format("elements = {}\n", contact.elements);
  } else if (name == "stribeck") {
    keys = fmt::format("fall_s_per_m = {}\nrise_s3_per_m3 = {}\n", contact.fall_s_per_m,
                       contact.rise_s3_per_m3);
  } else if (name == "normal_coulomb") {
    keys = fmt::format("normal_contact_stiffness_N_per_m = {:.17g}\n",
                       contact.normal_contact_stiffness_N_per_m);
  }
  if (scene::is_elastic(law)) {
    keys += fmt::format("contact_stiffness_N_per_m = {:.17g}\n", contact.contact_stiffness_N_per_m);
  }
  return keys;
}

using Profile = std::vector<std::pair<double, double>>;  ///< s, m/s

const std::vector<Profile> slidings = {
    {{0.0, 0.02}},
    {{0.0, 0.012}, {2.1e-5, 0.03}, {4.5e-5, 0.018}},
    {{0.0, 0.025}, {4.5e-5, -0.02}},
};

/// Carrier periods of a drive whose frequency follows a line, and of a spring that follows another.
constexpr double first_frequency_Hz = 57e3;
constexpr double last_frequency_Hz = 64e3;
constexpr double last_stiffness_N_per_m = 1.001 * undamped_mass.stiffness_N_per_m;

double chirp_Hz(double time_s) {
  return first_frequency_Hz + (last_frequency_Hz - first_frequency_Hz) * time_s / duration_s;
}
std::vector<double> chirp_periods_s() {
  std::vector<double> begins = {0.0};
  while (begins.back() < duration_s) {
    begins.push_back(begins.back() + 1.0 / chirp_Hz(begins.back()));
  }
  return begins;
}

/// Of each carrier period, to which the one before passes along a line, and the bias beside it.
constexpr double ramped_amplitudes_N[] = {250.0, 384.0, 120.0, 310.0};
constexpr double biases_N[] = {0.0, 60.0, -45.0, 20.0};

equations::Instant ramped_instant(double time_s, double piece_s, double sliding, double slope) {
  const auto period = static_cast<std::size_t>(piece_s * frequency_Hz);
  const double before_N = period > 0 ? ramped_amplitudes_N[period - 1] : 0.0;
  const double part = time_s * frequency_Hz - static_cast<double>(period);
  const double amplitude_N = before_N + (ramped_amplitudes_N[period] - before_N) * part;
  return {amplitude_N * std::cos(two_pi * part) + biases_N[period], sliding, slope};
}

/// A plant under these.
RunResult ramped_run(scene::Scene scene) {
  scene.drive->interpolation = scene::Interpolation::linear;
  scene.drive->bias_limit_N = 60.0;
  RunResult result;
  const Watch watch;
  CarrierClock clock(scene);
  PlantRun plant(scene, clock, watch, result);
  for (std::size_t i = 0; !clock.over(); ++i, clock.next()) {
    plant.advance(ramped_amplitudes_N[i], biases_N[i]);
  }
  plant.finish();
  return result;
}

/// As a scene names it.
struct Composition {
  scene::FrictionLaw law;
  bool damped;
  const scene::Waveform* waveform;  ///< null without a drive
  Profile sliding;
  bool changing = false;  ///< carrier frequency and spring
  bool ramped = false;    ///< the amplitude, beside a bias

  equations::Mass mass() const {
    equations::Mass mass = undamped_mass;
    mass.damping_N_s_per_m = damped ? damping_N_s_per_m : 0.0;
    return mass;
  }
  std::string_view drive_name() const {
    return waveform == nullptr ? "no drive" : scene::name_of(scene::waveforms, *waveform);
  }
  bool is_straight() const { return waveform != nullptr && *waveform != scene::Waveform::cosine; }
  std::string text(const std::string& solver) const;
};

std::string Composition::text(const std::string& solver) const {
  const double stiffness_N_per_m = mass().stiffness_N_per_m;
  const std::string spring =
      changing ? fmt::format("stiffness_profile = [[0, {:.17g}], [{}, {:.17g}]]", stiffness_N_per_m,
                             duration_s, last_stiffness_N_per_m)
               : fmt::format("stiffness_N_per_m = {:.17g}", stiffness_N_per_m);
  std::string text = fmt::format(
      "[plant]\nmass_kg = {}\n{}\ndamping_N_s_per_m = {}\n"
      "initial_displacement_m = {}\ninitial_velocity_m_per_s = {}\n",
      mass().mass_kg, spring, mass().damping_N_s_per_m, first_displacement_m,
      first_velocity_m_per_s);
  text += fmt::format("[friction]\nlaw = \"{}\"\n", scene::name_of(law));
  if (!scene::is<scene::laws::None>(law)) {
    text += fmt::format("coefficient = {}\nnormal_force_N = {}\n", contact.coefficient,
                        contact.normal_force_N) +
            own_keys(law);
  }
  text += "[sliding]\n";
  if (sliding.size() == 1) {
    text += fmt::format("velocity_m_per_s = {}\n", sliding.front().second);
  } else {
    std::vector<std::string> points;
    for (const auto& [time_s, velocity_m_per_s] : sliding) {
      points.push_back(fmt::format("[{}, {}]", time_s, velocity_m_per_s));
    }
    text += fmt::format("profile = [{}]\n", fmt::join(points, ", "));
  }
  if (waveform != nullptr) {
    text += fmt::format("[drive]\nfrequency_Hz = {}\nforce_amplitude_N = {}\nwaveform = \"{}\"\n",
                        frequency_Hz, drive_N, drive_name());
  }
  if (changing) {
    text += fmt::format("frequency_profile = [[0, {}], [{}, {}]]\n", first_frequency_Hz, duration_s,
                        last_frequency_Hz);
  }
  return text + fmt::format("[solver]\n{}[run]\nduration_s = {}\n", solver, duration_s);
}

/// Its peak at phase 0; `piece_s` is inside the straight piece that is meant.
double wave(scene::Waveform waveform, double time_s, double piece_s) {
  const double begun = std::floor(piece_s * frequency_Hz);
  const double part = time_s * frequency_Hz - begun;
  const bool first_half = piece_s * frequency_Hz - begun < 0.5;
  switch (waveform) {
    case scene::Waveform::square:
      return first_half ? 1.0 : -1.0;
    case scene::Waveform::triangle:
      return first_half ? 1.0 - 4.0 * part : 4.0 * part - 3.0;
    case scene::Waveform::sawtooth:
      return 1.0 - 2.0 * part;
    case scene::Waveform::cosine:
      break;
  }
  return std::cos(two_pi * time_s * frequency_Hz);
}

/// Where drive or sliding are not smooth, or the sliding turns.
std::vector<double> joints_s(const Profile& sliding) {
  std::vector<double> joints = {0.0, duration_s};
  for (double time_s = 0.5 * period_s; time_s < duration_s; time_s += 0.5 * period_s) {
    joints.push_back(time_s);
  }
  for (std::size_t i = 1; i < sliding.size(); ++i) {
    const auto& [from_s, from] = sliding[i - 1];
    const auto& [to_s, to] = sliding[i];
    joints.push_back(to_s);
    if (from * to < 0.0) {
      joints.push_back(from_s + (to_s - from_s) * from / (from - to));
    }
  }
  std::sort(joints.begin(), joints.end());
  return joints;
}

/// The sliding velocity at a time on the line that it follows at `piece_s`, and its slope.
std::pair<double, double> slide(const Profile& sliding, double time_s, double piece_s) {
  for (std::size_t i = 1; i < sliding.size(); ++i) {
    const auto& [from_s, from] = sliding[i - 1];
    const auto& [to_s, to] = sliding[i];
    if (piece_s < to_s) {
      const double slope = (to - from) / (to_s - from_s);
      return {from + slope * (time_s - from_s), slope};
    }
  }
  return {sliding.back().second, 0.0};
}

/// The drive and the spring of a composition in which both change, on the carrier period that has
/// begun at `begin_s`.
equations::Instant changing_instant(const Composition& composition, double begin_s, double time_s) {
  const double phase = two_pi * chirp_Hz(begin_s) * (time_s - begin_s);
  const double change_N_per_m = last_stiffness_N_per_m - undamped_mass.stiffness_N_per_m;
  return {drive_N * std::cos(phase), composition.sliding.front().second, 0.0,
          change_N_per_m * time_s / duration_s};
}

equations::State expected_state(const Composition& composition) {
  const auto friction =
      equations::make_equations(scene::name_of(composition.law), composition.mass(), contact);
  equations::State state{};
  if (friction == nullptr) {
    ADD_FAILURE() << "nobody has written this law down in SI units";
    return state;
  }
  state[0] = first_displacement_m;
  state[1] = first_velocity_m_per_s;
  const std::vector<double> joints =
      composition.changing ? chirp_periods_s() : joints_s(composition.sliding);
  for (std::size_t i = 1; i < joints.size(); ++i) {
    const double piece_s = 0.5 * (joints[i - 1] + joints[i]);
    const auto forcing = [&](double time_s) {
      if (composition.changing) {
        return changing_instant(composition, joints[i - 1], time_s);
      }
      const auto [velocity, slope] = slide(composition.sliding, time_s, piece_s);
      if (composition.ramped) {
        return ramped_instant(time_s, piece_s, velocity, slope);
      }
      const double force_N = composition.waveform == nullptr
                                 ? 0.0
                                 : drive_N * wave(*composition.waveform, time_s, piece_s);
      return equations::Instant{force_N, velocity, slope};
    };
    equations::follow(*friction, forcing, joints[i - 1], std::min(joints[i], duration_s),
                      period_s / 500.0, state);
  }
  return state;
}

/// Of the friction ratio; of displacement and velocity in the size of the vibration.
template <class Described>
constexpr double allowed_error() {
  if constexpr (Described::adaptive) {
    return Described::default_tolerance <= 1e-10 ? 1e-8 : 1e-4;
  }
  return 2e-3;
}

/// Settings with which a solver takes each order that is built, one each.
template <class Described>
std::vector<std::string> settings(const Composition& composition) {
  std::vector<std::string> settings;
  const auto add = [&](int order) {
    std::string text = fmt::format("method = \"{}\"\n", Described::name);
    if constexpr (!Described::adaptive) {
      text += fmt::format("step_s = {}\n", period_s / 4000.0);
    } else if constexpr (Described::takes_order) {
      text += fmt::format("tolerance = 1e-10\norder = {}\n", order);
    } else {
      const std::vector<double> tolerances = {1e-8, 1e-10, 1e-6};
      const auto suited = std::find_if(
          tolerances.begin(), tolerances.end(),
          [order](double tolerance) { return Described::order_for(tolerance) == order; });
      EXPECT_NE(suited, tolerances.end()) << "no tolerance takes order " << order;
      text += fmt::format("tolerance = {}\n", *suited);
    }
    settings.push_back(text);
  };
  if (composition.is_straight()) {
    std::for_each(Described::straight_orders.begin(), Described::straight_orders.end(), add);
  } else {
    std::for_each(Described::orders.begin(), Described::orders.end(), add);
  }
  return settings;
}

template <class Described>
bool is_solved(const Composition& composition) {
  const bool takes_law = std::visit(
      [](const auto& law) {
        return scene::takes_law<Described,
                                typename std::decay_t<decltype(law)>::template Core<double>>;
      },
      composition.law);
  return takes_law && (!composition.is_straight() || !Described::straight_orders.empty());
}

void expect_refused(const std::string& text) {
  try {
    experiment::read_text(text, "scene.toml");
    ADD_FAILURE() << "not refused";
  } catch (const scene_file::SceneError& error) {
    EXPECT_EQ(error.key(), "solver.method") << error.what();
  }
}

void expect_agreement(const Composition& composition, const std::string& solver, double allowed,
                      const equations::State& expected) {
  SCOPED_TRACE(solver);
  const scene::Scene scene = experiment::read_text(composition.text(solver), "scene.toml").plant;
  const RunResult result = composition.ramped ? ramped_run(scene) : run(scene);
  const double size_m = drive_N / (undamped_mass.stiffness_N_per_m +
                                   undamped_mass.mass_kg * std::pow(two_pi * frequency_Hz, 2));
  EXPECT_NEAR(result.final_state.displacement_m, expected[0], allowed * size_m);
  EXPECT_NEAR(result.final_state.velocity_m_per_s, expected[1],
              allowed * size_m * two_pi * frequency_Hz);
  const double limit_N_s = contact.limit_N() * duration_s;
  EXPECT_NEAR(result.whole.resistance_impulse_N_s / limit_N_s,
              expected[equations::impulse] / limit_N_s, allowed);
}

void try_every_solver(const Composition& composition) {
  SCOPED_TRACE(fmt::format("{}, {}, {}, sliding at {} points", scene::name_of(composition.law),
                           composition.drive_name(), composition.damped ? "damped" : "undamped",
                           composition.sliding.size()));
  const equations::State expected = expected_state(composition);
  scene::for_each_solver([&](auto described, scene::SolverMethod /*method*/) {
    using Described = decltype(described);
    if (!is_solved<Described>(composition)) {
      const Composition any = {scene::laws::None{}, false, nullptr, {}};
      expect_refused(composition.text(settings<Described>(any).front()));
      return;
    }
    for (const std::string& solver : settings<Described>(composition)) {
      expect_agreement(composition, solver, allowed_error<Described>(), expected);
    }
  });
}

class CompositionsTest : public testing::TestWithParam<scene::FrictionLaw> {};

TEST_P(CompositionsTest, AgreeWithTheEquations) {
  std::vector<const scene::Waveform*> waveforms = {nullptr};
  for (const auto& named : scene::waveforms) {
    waveforms.push_back(&named.value);
  }
  for (const scene::Waveform* waveform : waveforms) {
    for (const Profile& sliding : slidings) {
      for (const bool damped : {false, true}) {
        try_every_solver({GetParam(), damped, waveform, sliding});
      }
    }
  }
}

TEST_P(CompositionsTest, FollowACarrierAndASpringThatChange) {
  const scene::Waveform cosine = scene::Waveform::cosine;
  try_every_solver({GetParam(), true, &cosine, slidings.front(), true});
}

TEST_P(CompositionsTest, FollowAnAmplitudeThatPassesAlongALine) {
  const scene::Waveform cosine = scene::Waveform::cosine;
  for (const bool damped : {false, true}) {
    try_every_solver({GetParam(), damped, &cosine, slidings[damped ? 2 : 0], false, true});
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, CompositionsTest, testing::ValuesIn(scene::every_law),
                         [](const auto& tested) {
                           return std::string(scene::name_of(tested.param));
                         });

}  // namespace
}  // namespace sonoglide::loop::compositions_test
