/// What an FMU answers to an importer.

#include <gtest/gtest.h>

#include <fenv.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/acceptance/fmu/importer/fmu2.hpp"
#include "tests/acceptance/fmu/importer/fmu3.hpp"
#include "tests/acceptance/program/program.hpp"
#include "tests/common/scenes.hpp"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace sonoglide::acceptance::fmu_interface_test {
namespace {

constexpr std::uint64_t periods = 120;

const std::string scene = table_1_closed_loop + R"([run]
duration_s = 2e-3
[controller]
arithmetic = "float32"
target_friction_ratio = [[0.0, 0.4], [1e-3, 0.6]]
)";

/// One FMU for all tests here: they do not change it.
class FmuInterface : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = new ScratchFolder();
    folder->write("scene.toml", scene);
    make_fmu(*folder, "scene.toml", "--kind loop", "loop");
    fmu = new Fmu3(*folder, "loop");
  }
  static void TearDownTestSuite() {
    delete fmu;
    delete folder;
  }

  static std::string hash_of_run(const std::string& options = "") {
    const Outcome ran = folder->run("run scene.toml --json " + options);
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return nlohmann::json::parse(ran.out)["control"]["trace_hash"];
  }

  static double step_s() { return fmu->description().step_s(); }

  static ScratchFolder* folder;
  static Fmu3* fmu;
};

ScratchFolder* FmuInterface::folder = nullptr;
Fmu3* FmuInterface::fmu = nullptr;

TEST_F(FmuInterface, AStepIsAnyWholeNumberOfPeriods) {
  Instance3 loop(*fmu);
  loop.initialize();
  double time_s = 0.0;
  for (const int count : {1, 7, 32, 80}) {
    const Stepped stepped = loop.step(time_s, count * step_s());
    ASSERT_EQ(stepped.status, fmi3OK) << loop.messages();
    EXPECT_FALSE(stepped.early);
    time_s += count * step_s();
    EXPECT_NEAR(stepped.time_s, time_s, 1e-9 * step_s());
    EXPECT_EQ(loop.real("time"), stepped.time_s);
  }
  EXPECT_EQ(loop.text("trace_hash"), hash_of_run());
}

TEST_F(FmuInterface, AnyOtherStepIsRefusedAndChangesNothing) {
  Instance3 loop(*fmu);
  loop.initialize();
  for (const double part :
       {0.0, -1.0, 0.5, 1.5, 1.0 + 1e-5, 100.01, std::numeric_limits<double>::quiet_NaN(),
        std::numeric_limits<double>::infinity()}) {
    const Stepped stepped = loop.step(0.0, part * step_s());
    EXPECT_EQ(stepped.status, fmi3Discard) << part;
    EXPECT_EQ(stepped.time_s, 0.0);
  }
  EXPECT_NE(loop.messages().find("2 logStatusDiscard: the communication step of "
                                 "8.333333333333334e-06 s is 0.5 carrier periods; allowed: a whole "
                                 "number of 1.6666666666666667e-05 s"),
            std::string::npos)
      << loop.messages();
  EXPECT_EQ(loop.step(5.0 * step_s(), step_s()).status, fmi3Discard);
  EXPECT_NE(loop.messages().find("the communication point is"), std::string::npos);
  ASSERT_EQ(loop.step(0.0, periods * step_s()).status, fmi3OK);
  EXPECT_EQ(loop.text("trace_hash"), hash_of_run());
}

TEST_F(FmuInterface, ManyRoundedStepsStayOnTheGrid) {
  Instance3 loop(*fmu);
  loop.initialize(12345.678);
  const double rounded_s = 1.66666666667e-5;
  double time_s = 12345.678;
  for (std::uint64_t k = 0; k < periods; ++k) {
    ASSERT_EQ(loop.step(time_s, rounded_s).status, fmi3OK) << loop.messages();
    time_s += rounded_s;
  }
  EXPECT_EQ(loop.text("trace_hash"), hash_of_run());
}

TEST_F(FmuInterface, TwoInstancesInterleavedDoNotDisturbEachOther) {
  Instance3 one(*fmu);
  Instance3 other(*fmu);
  ASSERT_EQ(other.set("friction.coefficient", 0.12), fmi3OK);
  ASSERT_EQ(other.set("drive.delay_periods", std::int32_t{2}), fmi3OK);
  one.initialize();
  other.initialize();
  for (std::uint64_t k = 0; k < periods; ++k) {
    const double time_s = static_cast<double>(k) * step_s();
    ASSERT_EQ(one.step(time_s, step_s()).status, fmi3OK);
    ASSERT_EQ(other.step(time_s, step_s()).status, fmi3OK);
  }
  EXPECT_EQ(one.text("trace_hash"), hash_of_run());
  const std::string full_scale = fmu->description().start("sensor.force_full_scale_N");
  EXPECT_EQ(other.text("trace_hash"),
            hash_of_run("--set friction.coefficient=0.12 --set drive.delay_periods=2 --set "
                        "sensor.force_full_scale_N=" +
                        full_scale));
}

TEST_F(FmuInterface, AParameterOutOfRangeIsNamedWithItsPlaceAndCanBeMended) {
  Instance3 loop(*fmu);
  ASSERT_EQ(loop.set("plant.mass_kg", -1.0), fmi3OK);
  ASSERT_EQ(loop.enter(), fmi3OK);
  EXPECT_EQ(loop.exit(), fmi3Error);
  EXPECT_NE(loop.messages().find("logStatusError: --set:1:1: plant.mass_kg: "), std::string::npos)
      << loop.messages();
  ASSERT_EQ(loop.set("plant.mass_kg", 0.02), fmi3OK);
  ASSERT_EQ(loop.exit(), fmi3OK) << loop.messages();
  EXPECT_EQ(loop.real("plant.mass_kg"), 0.02);
  EXPECT_EQ(loop.set("plant.mass_kg", 0.03), fmi3Error) << "a fixed parameter";
  ASSERT_EQ(loop.step(0.0, periods * step_s()).status, fmi3OK);
  EXPECT_EQ(loop.text("trace_hash"), hash_of_run());
}

TEST_F(FmuInterface, ResetBeginsAnew) {
  Instance3 loop(*fmu);
  loop.set("plant.mass_kg", 0.03);
  loop.initialize();
  ASSERT_EQ(loop.step(0.0, 50 * step_s()).status, fmi3OK);
  ASSERT_EQ(SONOGLIDE_CALL3(loop, fmi3Terminate)(loop.get()), fmi3OK);
  EXPECT_EQ(loop.step(50 * step_s(), step_s()).status, fmi3Error);
  ASSERT_EQ(SONOGLIDE_CALL3(loop, fmi3Reset)(loop.get()), fmi3OK);
  loop.initialize();
  ASSERT_EQ(loop.step(0.0, periods * step_s()).status, fmi3OK);
  EXPECT_EQ(loop.text("trace_hash"), hash_of_run());
}

TEST_F(FmuInterface, AFaultEndsAStepEarlyWhereThatIsAllowed) {
  double ends_s[2] = {};
  for (const bool allowed : {true, false}) {
    Instance3 loop(*fmu, allowed);
    ASSERT_EQ(loop.set("sensor.force_gain", 0.0), fmi3OK);
    loop.initialize();
    const Stepped stepped = loop.step(0.0, 6000 * step_s());
    ASSERT_EQ(stepped.status, fmi3OK) << loop.messages();
    EXPECT_EQ(stepped.early, allowed);
    EXPECT_NE(loop.integer("fault"), 0);
    EXPECT_EQ(loop.integer("state"), 4);
    ends_s[allowed ? 1 : 0] = stepped.time_s;
    if (allowed) {
      ASSERT_EQ(loop.step(stepped.time_s, 10 * step_s()).status, fmi3OK);
      EXPECT_EQ(loop.real("drive_force_amplitude_N"), 0.0);
    }
  }
  EXPECT_LT(ends_s[1], ends_s[0]);
}

TEST_F(FmuInterface, ATargetFromOutsideTakesThePlaceOfTheSteps) {
  Instance3 loop(*fmu);
  loop.initialize();
  EXPECT_EQ(loop.set("target_friction_ratio", 1.5), fmi3Error);
  EXPECT_EQ(loop.set("target_friction_ratio", std::numeric_limits<double>::quiet_NaN()), fmi3Error);
  ASSERT_EQ(loop.set("target_friction_ratio", 0.4), fmi3OK);
  ASSERT_EQ(loop.step(0.0, periods * step_s()).status, fmi3OK);
  EXPECT_EQ(loop.text("trace_hash"),
            hash_of_run("--set 'controller.target_friction_ratio=[[0.0, 0.4]]'"));
}

TEST_F(FmuInterface, NativeTypesAreTheControllersOwnNumbers) {
  Instance3 loop(*fmu);
  loop.initialize();
  ASSERT_EQ(loop.step(0.0, periods * step_s()).status, fmi3OK);
  const std::int32_t code = loop.integer("drive_amplitude_code");
  EXPECT_GT(code, 0);
  EXPECT_EQ(loop.single("drive_amplitude"), std::ldexp(static_cast<float>(code), -31));
  EXPECT_EQ(loop.single("commanded_friction_ratio"),
            std::ldexp(static_cast<float>(loop.integer("commanded_ratio_code")), -30));
}

TEST_F(FmuInterface, WhatIsNotThereIsRefusedByName) {
  Instance3 loop(*fmu);
  loop.initialize();
  EXPECT_EQ(loop.set("friction_ratio", 0.5), fmi3Error);
  const unsigned none = 100000;
  double value = 0.0;
  EXPECT_EQ(SONOGLIDE_CALL3(loop, fmi3GetFloat64)(loop.get(), &none, 1, &value, 1), fmi3Error);
  EXPECT_NE(loop.messages().find("no variable of value reference 100000"), std::string::npos);
  const unsigned fault = fmu->description().reference("fault");
  EXPECT_EQ(SONOGLIDE_CALL3(loop, fmi3GetFloat64)(loop.get(), &fault, 1, &value, 1), fmi3Error);
  EXPECT_NE(loop.messages().find("fault is no Float64"), std::string::npos);
  EXPECT_EQ(SONOGLIDE_CALL3(loop, fmi3EnterEventMode)(loop.get()), fmi3Error);
  EXPECT_FALSE(Instance3(*fmu, false, "{another}").exists());
}

TEST_F(FmuInterface, DamagedAndForeignStatesAreRefused) {
  Instance3 loop(*fmu);
  loop.initialize();
  fmi3FMUState state = nullptr;
  ASSERT_EQ(SONOGLIDE_CALL3(loop, fmi3GetFMUState)(loop.get(), &state), fmi3OK);
  std::size_t size = 0;
  ASSERT_EQ(SONOGLIDE_CALL3(loop, fmi3SerializedFMUStateSize)(loop.get(), state, &size), fmi3OK);
  std::vector<std::uint8_t> bytes(size);
  ASSERT_EQ(SONOGLIDE_CALL3(loop, fmi3SerializeFMUState)(loop.get(), state, bytes.data(), size),
            fmi3OK);
  ASSERT_EQ(SONOGLIDE_CALL3(loop, fmi3FreeFMUState)(loop.get(), &state), fmi3OK);
  const auto read = [&](std::size_t count) {
    return SONOGLIDE_CALL3(loop, fmi3DeserializeFMUState)(loop.get(), bytes.data(), count, &state);
  };
  EXPECT_EQ(read(size - 1), fmi3Error);
  EXPECT_EQ(read(3), fmi3Error);
  EXPECT_EQ(read(0), fmi3Error);
  bytes[size / 2] ^= 1U;
  EXPECT_EQ(read(size), fmi3Error);
  EXPECT_EQ(state, nullptr);
  EXPECT_NE(loop.messages().find("the serialized state is damaged"), std::string::npos);
}

/// Rounding upwards and, where the processor has it, flush-to-zero.
class OddFloatingPoint {
 public:
  OddFloatingPoint() {
    fegetenv(&kept_);
    fesetround(FE_UPWARD);
#if defined(__SSE2__)
    _mm_setcsr(_mm_getcsr() | 0x8040U);
#endif
  }
  ~OddFloatingPoint() {
    fesetenv(&kept_);
  }
  OddFloatingPoint(const OddFloatingPoint&) = delete;
  OddFloatingPoint& operator=(const OddFloatingPoint&) = delete;

  bool stands() const {
#if defined(__SSE2__)
    return fegetround() == FE_UPWARD && (_mm_getcsr() & 0x8040U) == 0x8040U;
#else
    return fegetround() == FE_UPWARD;
#endif
  }

 private:
  fenv_t kept_;
};

TEST_F(FmuInterface, TheImportersFloatingPointChangesNoBitAndIsKept) {
  std::string hash;
  {
    const double size_s = periods * step_s();
    const OddFloatingPoint odd;
    Instance3 loop(*fmu);
    loop.initialize();
    EXPECT_EQ(loop.step(0.0, size_s).status, fmi3OK);
    hash = loop.text("trace_hash");
    EXPECT_TRUE(odd.stands());
  }
  EXPECT_EQ(hash, hash_of_run());
}

}  // namespace
}  // namespace sonoglide::acceptance::fmu_interface_test
