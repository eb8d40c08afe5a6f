/// FMUs of scenes whose carrier period changes, against `run`: the same commands, bit for bit.

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ostream>
#include <stdexcept>
#include <string>

#include "tests/acceptance/fmu/importer/fmu2.hpp"
#include "tests/acceptance/fmu/importer/fmu3.hpp"
#include "tests/acceptance/program/program.hpp"
#include "tests/common/scenes.hpp"

namespace sonoglide::acceptance::fmu_carrier_test {
namespace {

nlohmann::json run(const ScratchFolder& folder, const std::string& words) {
  const Outcome ran = folder.run("run " + words + " --json");
  if (ran.exit_code != 0) {
    throw std::runtime_error(ran.err);
  }
  return nlohmann::json::parse(ran.out);
}

/// A real device that follows its resonance.
struct Device {
  std::string scene;
  std::string options;
};

void PrintTo(const Device& device, std::ostream* out) {
  *out << device.scene;
}

class FmuCarrier : public testing::TestWithParam<Device> {
 protected:
  void SetUp() override {
    words_ = SONOGLIDE_SCENES "/" + GetParam().scene + ".toml " + GetParam().options;
    const nlohmann::json summary = run(folder_, words_);
    hash_ = summary["control"]["trace_hash"];
    end_s_ = summary["scene"]["run"]["duration_s"];
  }

  void make(const std::string& kind, const std::string& options = "") const {
    make_fmu(folder_, words_, "--kind " + kind + options, kind);
  }

  /// To the end of the run.
  template <class Step>
  void co_simulate(double step_s, const Step& step) const {
    for (double time_s = 0.0; time_s < end_s_;) {
      const double size_s = std::min(step_s, end_s_ - time_s);
      step(time_s, size_s);
      time_s += size_s;
    }
  }

  ScratchFolder folder_;
  std::string words_;
  std::string hash_;
  double end_s_ = 0.0;
};

TEST_P(FmuCarrier, ALoopGivesTheHashOfRunWhateverTheSteps) {
  make("loop");
  const Fmu3 fmu(folder_, "loop");
  EXPECT_EQ(fmu.description().stepping("fixedInternalStepSize"), "");
  for (const double steps : {1.0, 0.37, 12.3}) {
    Instance3 loop(fmu);
    loop.initialize();
    co_simulate(steps * fmu.description().step_s(), [&](double time_s, double size_s) {
      ASSERT_EQ(loop.step(time_s, size_s).status, fmi3OK) << loop.messages();
    });
    EXPECT_EQ(loop.text("trace_hash"), hash_) << steps;
  }
}

TEST_P(FmuCarrier, PlantAndControllerOneAfterTheOtherGiveTheHashOfRun) {
  make("plant");
  make("controller");
  const Fmu3 plant_fmu(folder_, "plant");
  const Fmu3 controller_fmu(folder_, "controller");
  for (const double steps : {1.0, 0.37}) {
    Instance3 plant(plant_fmu);
    Instance3 controller(controller_fmu);
    plant.initialize();
    controller.initialize();
    co_simulate(steps * plant_fmu.description().step_s(), [&](double time_s, double size_s) {
      for (const char* each : {"drive_force_amplitude_N", "drive_frequency_Hz"}) {
        plant.set(each, controller.real(each));
      }
      ASSERT_EQ(plant.step(time_s, size_s).status, fmi3OK) << plant.messages();
      for (const char* each : {"mean_friction_force_N", "sliding_velocity_m_per_s",
                               "vibration_in_phase_m_per_s", "vibration_quadrature_m_per_s"}) {
        controller.set(each, plant.real(each));
      }
      ASSERT_EQ(controller.step(time_s, size_s).status, fmi3OK) << controller.messages();
    });
    EXPECT_EQ(controller.text("trace_hash"), hash_) << steps;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, FmuCarrier,
                         testing::Values(Device{"wire_bonder", ""}, Device{"haptic_plate", ""},
                                         Device{"langevin",
                                                "--set run.duration_s=6e-3 --set "
                                                "'controller.target_friction_ratio=[[0.0, 0.5], "
                                                "[3e-3, 0.3]]'"},
                                         Device{"fingertip", "--set run.duration_s=12e-3"}),
                         [](const auto& tested) { return tested.param.scene; });

/// The state of a plant after 31 carrier periods of 60 kHz and 30 of 61 kHz.
TEST(FmuCarrierPlant, APlantGoesByTheFrequencyThatAMasterGivesIt) {
  const ScratchFolder folder;
  folder.write("scene.toml", table_1_open_loop + "[run]\nduration_s = 1e-3\n");
  const std::string profile =
      "scene.toml --set 'drive.frequency_profile=[[0.0, 60e3], [0.505e-3, 60e3], [0.505e-3, "
      "61e3]]'";
  const double end_s = 31.0 / 60e3 + 30.0 / 61e3;
  const nlohmann::json final =
      run(folder, profile + " --set run.duration_s=" + nlohmann::json(end_s).dump())["final"];
  make_fmu(folder, profile, "--kind plant --fmi 2", "plant");
  const Fmu2 fmu(folder, "plant");
  Instance2 plant(fmu);
  plant.initialize();
  EXPECT_EQ(plant.set("drive_frequency_Hz", 0.0), fmi2Error);
  ASSERT_EQ(plant.set("drive_frequency_Hz", 60e3), fmi2OK);
  ASSERT_EQ(plant.step(0.0, 31.0 / 60e3), fmi2OK) << plant.messages();
  ASSERT_EQ(plant.set("drive_frequency_Hz", 61e3), fmi2OK);
  ASSERT_EQ(plant.step(31.0 / 60e3, 30.0 / 61e3), fmi2OK) << plant.messages();
  EXPECT_EQ(plant.real("displacement_m"), final["displacement_m"]);
  EXPECT_EQ(plant.real("velocity_m_per_s"), final["velocity_m_per_s"]);
}

}  // namespace
}  // namespace sonoglide::acceptance::fmu_carrier_test
