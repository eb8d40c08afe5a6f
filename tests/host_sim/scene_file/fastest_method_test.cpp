/// Which method a scene gets that names none.
#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/scene/solver_facts.hpp"
#include "host_sim/scene_file/echo.hpp"
#include "host_sim/scene_file/reader.hpp"

namespace sonoglide::scene_file::fastest_method_test {
namespace {

using Settings = std::vector<std::string>;

scene::Solver solver_of(const std::string& name, const Settings& settings = {}) {
  return read_file(std::string(SONOGLIDE_SCENES) + "/" + name + ".toml", settings).solver;
}

std::string_view method_of(const std::string& name, const Settings& settings = {}) {
  return scene::name_of(solver_of(name, settings).method);
}

/// Of Table 1 in open loop, without its method.
std::string_view method_in_open_loop(Settings settings) {
  settings.emplace_back("solver.method=");
  return method_of("table_1_open_loop", settings);
}

TEST(FastestMethodTest, IsEventGaussAtTable1) {
  EXPECT_EQ(method_of("target_step"), "event_gauss");
  for (const char* tolerance : {"1e-5", "1e-6", "1e-8", "1e-10"}) {
    EXPECT_EQ(method_of("target_step", {std::string("solver.tolerance=") + tolerance}),
              "event_gauss")
        << tolerance;
    EXPECT_EQ(method_in_open_loop({std::string("solver.tolerance=") + tolerance}), "event_gauss")
        << tolerance;
  }
}

TEST(FastestMethodTest, IsTheOneThatTheSceneNames) {
  EXPECT_EQ(method_of("target_step", {"solver.method=event_taylor"}), "event_taylor");
  EXPECT_EQ(method_of("heavy_friction_open_loop", {"solver.method=event_gauss"}), "event_gauss");
}

TEST(FastestMethodTest, IsNamedInTheEcho) {
  const scene::Scene scene = read_file(std::string(SONOGLIDE_SCENES) + "/target_step.toml");
  EXPECT_EQ(to_json(scene).at("solver").at("method"), "event_gauss");
}

/// So that the worst plant of robust runs again as it ran there.
TEST(FastestMethodTest, IsThatOfTheSceneForATruePlantToo) {
  const scene::Scene plant =
      experiment::read_file(std::string(SONOGLIDE_SCENES) + "/target_step.toml",
                            {"true_values.\"friction.contact_stiffness_N_per_m\"=1e9"})
          .plant;
  ASSERT_EQ(plant.friction.contact_stiffness_N_per_m, 1e9);
  EXPECT_EQ(scene::name_of(plant.solver.method), "event_gauss");
}

TEST(FastestMethodTest, IsEventTaylorWhereEventGaussDoesNotServe) {
  for (const Settings& settings :
       {Settings{"drive.waveform=square"},
        {"friction.law=coulomb", "friction.contact_stiffness_N_per_m="},
        {"friction.law=none", "friction.coefficient=", "friction.contact_stiffness_N_per_m="},
        {"friction.coefficient=0"},
        {"solver.order=12"},
        {"drive.frequency_profile=[[0,60e3],[1e-4,60.1e3]]"},
        {"friction.coefficient=", "friction.coefficient_profile=[[0,0.1],[1e-3,0.2]]"},
        {"plant.stiffness_N_per_m=", "plant.stiffness_profile=[[0,133e6],[1e-3,130e6]]"}}) {
    EXPECT_EQ(method_in_open_loop(settings), "event_taylor") << settings.front();
  }
  EXPECT_EQ(method_of("wire_bonder"), "event_taylor");  // its carrier follows the resonance
}

TEST(FastestMethodTest, IsEventTaylorWhereEventGaussIsNotTheFaster) {
  for (const char* setting :
       {"solver.tolerance=1e-4", "solver.tolerance=1e-11", "friction.contact_stiffness_N_per_m=1e9",
        "friction.contact_stiffness_N_per_m=1e3", "friction.normal_force_N=2000",
        "sliding.velocity_m_per_s=1", "plant.stiffness_N_per_m=2e9",
        "plant.damping_N_s_per_m=1e3"}) {
    EXPECT_EQ(method_in_open_loop({setting}), "event_taylor") << setting;
  }
}

}  // namespace
}  // namespace sonoglide::scene_file::fastest_method_test
