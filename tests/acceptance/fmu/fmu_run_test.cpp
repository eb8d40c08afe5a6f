/// FMUs in a co-simulation against `run`: the same commands, bit for bit.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/acceptance/fmu/importer/fmu2.hpp"
#include "tests/acceptance/fmu/importer/fmu3.hpp"
#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance::fmu_run_test {
namespace {

/// An example scene and what makes another of it.
struct Case {
  std::string name;
  std::string scene;
  std::string options;

  std::string words() const { return SONOGLIDE_SCENES "/" + scene + ".toml " + options; }
};

void PrintTo(const Case& tested, std::ostream* out) {
  *out << tested.name;
}

/// Every arithmetic, every kind of solver, and what a plant and a loop carry from one period to the
/// next: an amplitude that passes, noise, profiles, an observed vibration.
const std::vector<Case> cases = {
    {"float32", "target_step",
     "--set solver.tolerance=1e-6 --set drive.interpolation=linear --set drive.codes_per_period=4"},
    {"q31", "target_step_q31",
     "--set solver.method=event_gauss --set solver.tolerance=1e-6 --set "
     "drive.interpolation=linear"},
    {"q15", "target_step_q15",
     "--set solver.method=strang --set solver.tolerance= --set solver.step_s=1e-7"},
    {"noise", "noisy_sensor", "--set solver.tolerance=1e-6"},
    {"friction_profile", "friction_jump", "--set solver.tolerance=1e-6"},
    {"speed_profile", "speed_ramp", "--set solver.tolerance=1e-6"},
    {"damped", "damped_step", ""},
    {"texture", "target_step_q31",
     "--set solver.tolerance=1e-6 --set controller.target_friction_ratio= --set "
     "'controller.target_texture={ period_m = 53.44e-6, ratio = [0.4, 0.6] }'"},
};

class FmuRun : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    const nlohmann::json summary = run(GetParam().words());
    hash_ = summary["control"]["trace_hash"];
    const double periods = summary["scene"]["run"]["duration_s"].get<double>() *
                           summary["scene"]["drive"]["frequency_Hz"].get<double>();
    periods_ = static_cast<std::uint64_t>(std::floor(periods + 1e-6));
  }

  nlohmann::json run(const std::string& words) const {
    const Outcome ran = folder_.run("run " + words + " --json --set 'run.record=[]'" +
                                    " --set run.record_interval_s=");
    if (ran.exit_code != 0) {
      throw std::runtime_error(ran.err);
    }
    return nlohmann::json::parse(ran.out);
  }
  /// Of a loop in which a number is another one than the controller believes.
  std::string hash_with_true_value(const std::string& value) const {
    std::ifstream file(SONOGLIDE_SCENES "/" + GetParam().scene + ".toml");
    std::ostringstream scene;
    scene << file.rdbuf() << "\n[true_values]\n" << value << "\n";
    folder_.write("true.toml", scene.str());
    return run("true.toml " + GetParam().options)["control"]["trace_hash"];
  }

  void make(const std::string& kind, const std::string& options = "") const {
    make_fmu(folder_, GetParam().words(), "--kind " + kind + options, kind);
  }

  ScratchFolder folder_;
  std::string hash_;
  std::uint64_t periods_ = 0;
};

/// Communication points as a master has them that adds up steps.
template <class Step>
void co_simulate(double step_s, std::uint64_t periods, const Step& step) {
  double time_s = 0.0;
  for (std::uint64_t k = 0; k < periods; ++k) {
    step(time_s);
    time_s += step_s;
  }
}

/// The state in the middle of a run.
std::vector<std::uint8_t> serialized_state(const Fmu3& fmu, double until_s) {
  Instance3 first(fmu);
  first.initialize();
  EXPECT_EQ(first.step(0.0, until_s).status, fmi3OK);
  return first.serialized_state();
}

TEST_P(FmuRun, ALoopGivesTheHashOfRunAlsoFromAStateInMidRun) {
  make("loop");
  const Fmu3 fmu(folder_, "loop");
  Instance3 loop(fmu);
  loop.initialize();
  const double step_s = fmu.description().step_s();
  co_simulate(step_s, periods_, [&](double time_s) {
    ASSERT_EQ(loop.step(time_s, step_s).status, fmi3OK) << loop.messages();
  });
  EXPECT_EQ(loop.text("trace_hash"), hash_);

  const std::uint64_t half = periods_ / 2;
  const double half_s = static_cast<double>(half) * step_s;
  const std::vector<std::uint8_t> bytes = serialized_state(fmu, half_s);
  Instance3 second(fmu);
  second.initialize();
  fmi3FMUState state = nullptr;
  ASSERT_EQ(SONOGLIDE_CALL3(second, fmi3DeserializeFMUState)(second.get(), bytes.data(),
                                                             bytes.size(), &state),
            fmi3OK)
      << second.messages();
  for (int time = 0; time < 2; ++time) {
    ASSERT_EQ(SONOGLIDE_CALL3(second, fmi3SetFMUState)(second.get(), state), fmi3OK);
    const double rest_s = static_cast<double>(periods_ - half) * step_s;
    ASSERT_EQ(second.step(half_s, rest_s).status, fmi3OK) << second.messages();
    EXPECT_EQ(second.text("trace_hash"), hash_);
  }
  ASSERT_EQ(SONOGLIDE_CALL3(second, fmi3FreeFMUState)(second.get(), &state), fmi3OK);
}

TEST_P(FmuRun, PlantAndControllerOneAfterTheOtherGiveTheHashOfRun) {
  make("plant");
  make("controller");
  const Fmu3 plant_fmu(folder_, "plant");
  const Fmu3 controller_fmu(folder_, "controller");
  Instance3 plant(plant_fmu);
  Instance3 controller(controller_fmu);
  plant.initialize();
  controller.initialize();
  std::vector<std::string> measured = {"mean_friction_force_N", "sliding_velocity_m_per_s"};
  if (GetParam().name == "damped") {
    measured.insert(measured.end(), {"vibration_in_phase_m_per_s", "vibration_quadrature_m_per_s"});
  }
  const double step_s = plant_fmu.description().step_s();
  co_simulate(step_s, periods_, [&](double time_s) {
    plant.set("drive_force_amplitude_N", controller.real("drive_force_amplitude_N"));
    ASSERT_EQ(plant.step(time_s, step_s).status, fmi3OK) << plant.messages();
    for (const std::string& each : measured) {
      controller.set(each, plant.real(each));
    }
    ASSERT_EQ(controller.step(time_s, step_s).status, fmi3OK) << controller.messages();
  });
  EXPECT_EQ(controller.text("trace_hash"), hash_);
}

INSTANTIATE_TEST_SUITE_P(Scenes, FmuRun, testing::ValuesIn(cases),
                         [](const auto& tested) { return tested.param.name; });

class FmuRunJacobi : public FmuRun {};

/// Both step at once with the outputs of the communication point before: the controller then is one
/// whose force reading is one carrier period later than it believes. The sliding velocity, which
/// is late too, is constant in these scenes.
TEST_P(FmuRunJacobi, AJacobiMasterMakesTheForceReadingOnePeriodLate) {
  make("plant");
  make("controller");
  const Fmu3 plant_fmu(folder_, "plant");
  const Fmu3 controller_fmu(folder_, "controller");
  Instance3 plant(plant_fmu);
  Instance3 controller(controller_fmu);
  plant.initialize();
  controller.initialize();
  const double step_s = plant_fmu.description().step_s();
  co_simulate(step_s, periods_, [&](double time_s) {
    plant.set("drive_force_amplitude_N", controller.real("drive_force_amplitude_N"));
    for (const char* each : {"mean_friction_force_N", "sliding_velocity_m_per_s"}) {
      controller.set(each, plant.real(each));
    }
    ASSERT_EQ(plant.step(time_s, step_s).status, fmi3OK) << plant.messages();
    ASSERT_EQ(controller.step(time_s, step_s).status, fmi3OK) << controller.messages();
  });
  const std::string hash = controller.text("trace_hash");
  EXPECT_NE(hash, hash_);
  EXPECT_EQ(hash, hash_with_true_value("\"sensor.delay_periods\" = 1"));
  EXPECT_NE(hash, hash_with_true_value("\"drive.delay_periods\" = 2")) << "another trace";
}

INSTANTIATE_TEST_SUITE_P(Scenes, FmuRunJacobi, testing::Values(cases[0], cases[3]),
                         [](const auto& tested) { return tested.param.name; });

class FmuRun2 : public FmuRun {};

TEST_P(FmuRun2, ALoopOfVersion2GivesTheHashOfRunAlsoFromAStateInMidRun) {
  make("loop", " --fmi 2");
  const Fmu2 fmu(folder_, "loop");
  Instance2 loop(fmu);
  loop.initialize();
  const double step_s = fmu.description().step_s();
  fmi2FMUstate state = nullptr;
  const std::uint64_t half = periods_ / 2;
  std::uint64_t done = 0;
  co_simulate(step_s, periods_, [&](double time_s) {
    if (done++ == half) {
      ASSERT_EQ(SONOGLIDE_CALL2(loop, fmi2GetFMUstate)(loop.get(), &state), fmi2OK);
    }
    ASSERT_EQ(loop.step(time_s, step_s), fmi2OK) << loop.messages();
  });
  EXPECT_EQ(loop.text("trace_hash"), hash_);
  ASSERT_EQ(SONOGLIDE_CALL2(loop, fmi2SetFMUstate)(loop.get(), state), fmi2OK);
  EXPECT_NE(loop.text("trace_hash"), hash_);
  ASSERT_EQ(
      loop.step(static_cast<double>(half) * step_s, static_cast<double>(periods_ - half) * step_s),
      fmi2OK);
  EXPECT_EQ(loop.text("trace_hash"), hash_);
  ASSERT_EQ(SONOGLIDE_CALL2(loop, fmi2FreeFMUstate)(loop.get(), &state), fmi2OK);
}

INSTANTIATE_TEST_SUITE_P(Scenes, FmuRun2, testing::Values(cases[0]),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace sonoglide::acceptance::fmu_run_test
