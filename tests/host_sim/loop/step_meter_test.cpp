/// The steps of a carrier period: their limit, their pulse, and how many are foreseen.
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "host_sim/loop/plant/failure.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/loop/step_forecast.hpp"
#include "host_sim/scene/solver_methods.hpp"
#include "tests/common/table_1.hpp"

namespace sonoglide::loop::step_meter_test {
namespace {

using tests::period_s;
using tests::table_1;

/// A slow body on a contact that relaxes in 1e-11 s, and a spring whose slope cuts each carrier
/// period into pieces.
scene::Scene cut_into_pieces() {
  scene::Scene scene = table_1();
  scene::laws::LuGre law;
  law.static_coefficient = 0.12;
  law.stribeck_velocity_m_per_s = 0.03;
  scene.friction.law = law;
  scene.friction.contact_stiffness_N_per_m = 1e13;
  scene.plant.stiffness_profile = {{0.0, 133e6}, {1e-3, 130e6}};
  scene.run.duration_s = 20.0 * period_s;
  scene.run.window_start_s = 0.0;
  return scene;
}

TEST(StepMeterTest, TheLimitIsOfACarrierPeriodHoweverItIsCut) {
  try {
    run(cut_into_pieces());
    FAIL() << "nothing was thrown";
  } catch (const ComputationError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("needs more than 1000000 steps (100000"), std::string::npos) << message;
    EXPECT_NE(message.find("slides to its limit within Fc/(Kt Vt)"), std::string::npos) << message;
  }
}

TEST(StepMeterTest, ARunCanBeEndedInsideACarrierPeriod) {
  Watch watch;
  int calls = 0;
  watch.progress = [&](double fraction) {
    EXPECT_EQ(fraction, 0.0);
    if (++calls == 3) {
      throw std::runtime_error("enough");
    }
  };
  EXPECT_THROW(run(cut_into_pieces(), watch), std::runtime_error);
  EXPECT_EQ(calls, 3);
}

TEST(StepForecastTest, IsRightToAFactorOfThree) {
  for (const double frequency_Hz : {32.0, 1e3, tests::carrier_Hz}) {
    scene::Scene scene = table_1();
    scene.plant.damping_N_s_per_m = 20.0;
    scene.friction.contact_stiffness_N_per_m = 1e9;
    scene.drive->frequency_Hz = frequency_Hz;
    scene.sliding.profile = {{0.0, 5e-4}};
    scene.run.duration_s = 20.0 / frequency_Hz;
    scene.run.window_start_s = 0.0;
    const auto steps = static_cast<double>(run(scene).solver_steps);
    EXPECT_GT(expected_steps(scene), steps / 3.0) << frequency_Hz;
    EXPECT_LT(expected_steps(scene), 3.0 * steps) << frequency_Hz;
  }
}

TEST(StepForecastTest, TellsOfARunThatWouldNotEndSoon) {
  EXPECT_GT(expected_steps(cut_into_pieces()), 1e8);
}

}  // namespace
}  // namespace sonoglide::loop::step_meter_test
