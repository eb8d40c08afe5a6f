/// A run, the same run while it is sampled, and the same stepped from outside are one motion, bit
/// for bit: every solver, law and profile, in open and in closed loop.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "host_sim/loop/run.hpp"
#include "host_sim/loop/stepped.hpp"
#include "host_sim/scene/cores/solver_cores.hpp"
#include "host_sim/scene/law_cores.hpp"
#include "host_sim/scene/solver_methods.hpp"
#include "tests/common/table_1.hpp"
#include "tests/host_sim/loop/random/random_scene.hpp"

namespace sonoglide::loop::one_motion_test {
namespace {

using scene::Scene;
using tests::period_s;

constexpr int periods = 6;

struct Profile {
  std::string name;
  std::function<void(Scene&)> add;
};

const std::vector<Profile>& profiles() {
  static const std::vector<Profile> all = {
      {"none", [](Scene& /*scene*/) {}},
      {"sliding",
       [](Scene& scene) {
         const double fast = scene.sliding.profile.front().velocity_m_per_s;
         scene.sliding.profile = {
             {0.0, fast}, {2.3 * period_s, 0.6 * fast}, {5.1 * period_s, 0.9 * fast}};
       }},
      {"coefficient",
       [](Scene& scene) {
         const double most = scene.friction.coefficient;
         scene.friction.coefficient_profile = {{0.0, most}, {4.4 * period_s, 0.8 * most}};
       }},
      {"normal force",
       [](Scene& scene) {
         const double least = scene.friction.normal_force_N;
         scene.friction.normal_force_profile_N = {
             {1.2 * period_s, least}, {1.2 * period_s, 1.1 * least}, {5.5 * period_s, 1.3 * least}};
       }},
      {"stiffness",
       [](Scene& scene) {
         const double least = scene.plant.stiffness_N_per_m;
         scene.plant.stiffness_profile = {{0.7 * period_s, least}, {5.0 * period_s, 1.02 * least}};
       }},
  };
  return all;
}

/// Friction that is felt.
Scene table_1(const scene::FrictionLaw& law, scene::SolverMethod method, bool closed) {
  Scene scene = closed ? tests::table_1_closed_loop() : tests::table_1();
  scene.plant.damping_N_s_per_m = 30.0;
  scene.friction.law = law;
  scene.friction.normal_force_N = 30.0;
  scene.friction.contact_stiffness_N_per_m = scene::is_elastic(law) ? 5e6 : 0.0;
  tests::Dice dice(7);
  const double velocity = tests::vibration_velocity_m_per_s(scene.plant, 384.0);
  std::visit(tests::OwnKeys(dice, {velocity * period_s, velocity, scene.friction.limit_N(),
                                   scene.friction.normal_force_N}),
             scene.friction.law);
  scene.sensor.force_full_scale_N = 4.0 * scene.friction.limit_N();
  scene.solver.method = method;
  scene.solver.tolerance = 1e-6;
  scene.solver.step_s = period_s / 200.0;
  scene.run.window_start_s = 0.0;
  scene.run.duration_s = periods * period_s;
  return scene;
}

struct End {
  PlantState state;
  std::uint64_t trace_hash = 0;
};

struct Unread final : SampleSink {
  void take(const PlantSample& /*sample*/) override {}
};

End ran(const Scene& scene, const Watch& watch = {}) {
  const RunResult result = run(scene, watch);
  return {result.final_state, result.control ? result.control->trace_hash : 0};
}

End sampled(const Scene& scene) {
  Unread sink;
  Watch watch;
  watch.samples = {{{0.0, scene.run.duration_s, 0.037 * period_s}, &sink},
                   {{1.1 * period_s, 3.0 * period_s, 0.21 * period_s}, &sink}};
  return ran(scene, watch);
}

End stepped(const Scene& scene) {
  loop::SteppedScene engine(configure::make_experiment(scene),
                            scene.controller ? loop::Kind::loop : loop::Kind::plant);
  loop::Inputs inputs;
  inputs.drive_force_amplitude_N = scene.drive->force_amplitude_N;
  for (int i = 0; i < periods; ++i) {
    engine.advance(inputs);
  }
  const loop::PlantOutputs& plant = engine.plant();
  return {{plant.displacement_m, plant.velocity_m_per_s, plant.friction_force_N},
          scene.controller ? engine.controller().trace_hash : 0};
}

void expect_same(const End& one, const End& other) {
  EXPECT_EQ(one.state.displacement_m, other.state.displacement_m);
  EXPECT_EQ(one.state.velocity_m_per_s, other.state.velocity_m_per_s);
  EXPECT_EQ(one.state.friction_force_N, other.state.friction_force_N);
  EXPECT_EQ(one.trace_hash, other.trace_hash);
}

class OneMotionTest : public testing::TestWithParam<scene::FrictionLaw> {};

TEST_P(OneMotionTest, RunSampledAndStepped) {
  const bool has_friction = !scene::is<scene::laws::None>(GetParam());
  scene::for_each_solver([&](auto described, scene::SolverMethod method) {
    const bool takes = std::visit(
        [](const auto& law) {
          return scene::takes_law<decltype(described),
                                  typename std::decay_t<decltype(law)>::template Core<double>>;
        },
        GetParam());
    for (const bool closed : {false, true}) {
      for (const Profile& profile : profiles()) {
        if (!takes || (closed && !has_friction)) {
          continue;
        }
        SCOPED_TRACE(std::string(decltype(described)::name) + ", " + profile.name +
                     (closed ? ", closed" : ", open"));
        Scene scene = table_1(GetParam(), method, closed);
        profile.add(scene);
        const End whole = ran(scene);
        expect_same(whole, sampled(scene));
        expect_same(whole, stepped(scene));
      }
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Laws, OneMotionTest, testing::ValuesIn(scene::every_law),
                         [](const auto& tested) {
                           return std::string(scene::name_of(tested.param));
                         });

/// The resonance followed, and the natural mode damped.
TEST(OneMotionOfVibrationTest, RunSampledAndStepped) {
  for (const auto control : {scene::VibrationControl::damped, scene::VibrationControl::resonant}) {
    for (const Profile& profile : profiles()) {
      SCOPED_TRACE(profile.name);
      Scene scene = table_1(scene::laws::Dahl{}, scene::method_of<scene::solvers::Strang>, true);
      if (control == scene::VibrationControl::resonant) {
        scene.plant.stiffness_N_per_m = 0.02 * std::pow(2.0 * tests::pi * tests::carrier_Hz, 2);
        scene.plant.damping_N_s_per_m = 0.005 * 0.02 * 2.0 * tests::pi * tests::carrier_Hz;
        scene.drive->max_force_amplitude_N = 30.0;
        scene.controller->frequency_range_Hz = scene::FrequencyRange{58e3, 62e3};
      }
      scene.controller->vibration = control;
      scene.sensor.vibration = scene::VibrationSensor::velocity;
      profile.add(scene);
      const End whole = ran(scene);
      expect_same(whole, sampled(scene));
      if (control == scene::VibrationControl::damped) {
        expect_same(whole, stepped(scene));
      }
    }
  }
}

}  // namespace
}  // namespace sonoglide::loop::one_motion_test
