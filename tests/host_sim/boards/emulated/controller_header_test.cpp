#include "host_sim/boards/emulated/controller_header.hpp"
#include "host_sim/boards/emulated/board_limits.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "host_sim/boards/emulated/board_list.hpp"
#include "host_sim/boards/emulated/initialiser.hpp"
#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/configure/controller_parameters.hpp"
#include "host_sim/configure/controller_parts.hpp"
#include "host_sim/configure/read/experiment.hpp"

namespace sonoglide::emulated::controller_header_test {
namespace {

experiment::Experiment read(const std::string& name,
                            const std::vector<std::string>& overrides = {}) {
  return experiment::read_file(SONOGLIDE_SCENES "/" + name + ".toml", overrides);
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// The key of the error that a header ends in; empty where there is none.
std::string refused_key(const experiment::Experiment& experiment) {
  try {
    controller_header(experiment);
  } catch (const configure::ConfigurationError& error) {
    return error.key();
  }
  return "";
}

TEST(ControllerHeader, NamesTheSceneAndItsScalar) {
  EXPECT_TRUE(has(controller_header(read("target_step")), "of the scene target_step."));
  EXPECT_TRUE(has(controller_header(read("target_step")), "using Scalar = float;"));
  EXPECT_TRUE(has(controller_header(read("target_step_q31")), "using Scalar = numeric::Q31"));
  EXPECT_TRUE(has(controller_header(read("target_step_q15")), "using Scalar = numeric::Q15"));
  EXPECT_TRUE(has(controller_header(read("target_step_float64")), "using Scalar = double;"));
}

TEST(ControllerHeader, HoldsTheParametersThatTheSimulationRuns) {
  using Parts =
      control::Parts<float, control::TrustedFriction<float>, control::DahlFeedforward<float>,
                     control::NoSlewLimit<float>, control::NotchShaper<float, 32>,
                     control::IntegralRegulator<float, 32>>;
  const experiment::Experiment experiment = read("target_step");
  const auto parameters = configure::controller_parameters<Parts>(*experiment.design);
  const std::string header = controller_header(experiment);
  std::size_t end = 0;
  const auto expect_next = [&](const char* name, const auto& field) {
    end = header.find("\n    " + Initialiser<float>::of(field) + ",  // ", end);
    EXPECT_NE(end, std::string::npos) << name;
  };
  control::Controller<Parts>::Parameters::fields(parameters, expect_next);
}

// 1/30 of 2^31: a share of the mean that 16 bits could not hold for long calibrations.
TEST(ControllerHeader, KeepsTheWeightsOfCalibrationIn32Bits) {
  const std::string header =
      controller_header(read("target_step_q15", {"controller.calibration_s=1e-3"}));
  EXPECT_TRUE(has(header, "{29, 30, numeric::Accumulator<Scalar>::from_raw(71582788), 59, "))
      << header;
}

TEST(ControllerHeader, ARobustNotchHasFiveTapsThatAddUpToOne) {
  EXPECT_TRUE(has(controller_header(read("target_step")), "NotchShaper<Scalar, 1>"));
  const std::string header =
      controller_header(read("target_step_q15", {"controller.shaping=\"robust\""}));
  EXPECT_TRUE(has(header, "NotchShaper<Scalar, 1, 5>")) << header;
  EXPECT_TRUE(has(header,
                  "{{Scalar::from_raw(13250), Scalar::from_raw(-11032), Scalar::from_raw(28332), "
                  "Scalar::from_raw(-11032), Scalar::from_raw(13250)}, 1}"))
      << header;
}

TEST(ControllerHeader, HoldsNoPartThatTheSceneDoesNotName) {
  const std::string shaped = controller_header(read("target_step"));
  const std::string unshaped = controller_header(read("target_step_unshaped"));
  EXPECT_TRUE(has(shaped, "control::NotchShaper<"));
  EXPECT_FALSE(has(unshaped, "control::NotchShaper<"));
  EXPECT_FALSE(has(shaped, "control::SlewLimit<"));
  // A mode at twice the carrier can neither be notched out nor fed back to.
  const std::string fed_forward =
      controller_header(read("target_step", {"drive.frequency_Hz=6489"}));
  EXPECT_TRUE(has(shaped, "control::IntegralRegulator<"));
  EXPECT_FALSE(has(fed_forward, "control::IntegralRegulator<"));
}

// The step at 2 ms is answered by the sample that ends the carrier period 119, counted from 0.
TEST(ControllerHeader, CountsTheTargetsInCarrierPeriods) {
  EXPECT_TRUE(has(controller_header(read("target_step")), "{119, "));
  // So late that 2e-16 of the time is more than 1e-9 of a period.
  EXPECT_TRUE(has(controller_header(
                      read("target_step", {"controller.target_friction_ratio=[[0.0,0.4],[1e3,0.5]]",
                                           "run.duration_s=2e3", "run.record_interval_s=1e-3"})),
                  "{59999999, "));
}

// In the order of link::Quantity.
TEST(ControllerHeader, StatesTheFullScalesInSiUnits) {
  const auto scales = [](const experiment::Experiment& experiment) {
    const std::string header = controller_header(experiment);
    const std::size_t begin = header.find("full_scales{{\n");
    return header.substr(begin, header.find("}};", begin) - begin);
  };
  const experiment::Experiment of_ratio = read("target_step", {"sensor.force_full_scale_N=0.5"});
  EXPECT_EQ(scales(of_ratio),
            "full_scales{{\n"
            "    {link::ScaleUnit::newton, 0x1p-1},  // friction_force: 0.5\n" +
                fmt::format(
                    "    {{link::ScaleUnit::metre_per_second, {0:a}}},  // sliding_velocity: {0}\n",
                    of_ratio.design->scales.velocity_m_per_s) +
                "    {link::ScaleUnit::newton, 0x1.ep+10},  // amplitude: 1920\n"
                "    {link::ScaleUnit::ratio, 0x1p+0},  // target: 1\n"
                "    {link::ScaleUnit::none, 0x0p+0},  // bias: 0\n" +
                fmt::format("    {{link::ScaleUnit::second, {0:a}}},  // step: {0}\n", 1.0 / 60e3));
  const std::string of_belt = scales(read("belt_force"));
  EXPECT_TRUE(has(of_belt, "{link::ScaleUnit::volt, 0x1.f4p+8},  // amplitude: 500\n")) << of_belt;
  EXPECT_TRUE(has(of_belt, "{link::ScaleUnit::newton, 0x1.2cp+9},  // target: 600\n")) << of_belt;
  EXPECT_TRUE(
      has(scales(read("target_step", {"drive.bias_limit_N=0.5", "plant.stiffness_N_per_m=25e6"})),
          "{link::ScaleUnit::newton, 0x1p-1},  // bias: 0.5\n"));
}

TEST(ControllerHeader, IsForClosedLoopsWithTargetsInReach) {
  EXPECT_EQ(refused_key(read("table_1_open_loop")), "controller");
  EXPECT_EQ(
      refused_key(read("target_step", {"controller.target_friction_ratio=[[0.0,0.4],[8e4,0.5]]",
                                       "run.duration_s=1e5", "run.record_interval_s=1e-3"})),
      "controller.target_friction_ratio");
}

TEST(BoardArithmetic, Float64NeedsABoardThatComputesIt) {
  int computing = 0;
  for (const emulated::EmulatedBoard& board : emulated::emulated_boards()) {
    EXPECT_NO_THROW(require_arithmetic(read("target_step").plant, board));
    EXPECT_NO_THROW(require_arithmetic(read("target_step_q31").plant, board));
    if (board.name == "mps2-an500") {
      EXPECT_NO_THROW(require_arithmetic(read("target_step_float64").plant, board));
      ++computing;
    } else {
      EXPECT_THROW(require_arithmetic(read("target_step_float64").plant, board),
                   configure::ConfigurationError);
    }
  }
  EXPECT_EQ(computing, 1);
}

}  // namespace
}  // namespace sonoglide::emulated::controller_header_test
