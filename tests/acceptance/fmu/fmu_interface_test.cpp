/// What an FMU answers to an importer.

#include <gtest/gtest.h>

#include <fenv.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "tests/acceptance/fmu/importer/one_loop.hpp"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace sonoglide::acceptance::fmu_interface_test {
namespace {

using one_loop::periods;

class FmuInterface : public one_loop::OneLoop {};

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

/// Lengths of steps in carrier periods, over and over until the run is over; the last one is cut.
template <class Step>
void step_by(const std::vector<double>& lengths, double period_s, const Step& step) {
  const double end_s = periods * period_s;
  double time_s = 0.0;
  for (std::size_t i = 0; time_s < end_s; ++i) {
    const double size_s = std::min(lengths[i % lengths.size()] * period_s, end_s - time_s);
    step(time_s, size_s);
    time_s += size_s;
  }
}

/// Steps of less than a period, of some and a part of one, and remnants as rounding leaves them.
const std::vector<std::vector<double>> odd_lengths = {
    {0.3}, {0.7}, {2.5}, {3.14159265358979, 1e-12, 0.01}, {1.0 - 1e-5}, {1.0 + 1e-5}, {1e3}};

TEST_F(FmuInterface, AnyStepsGiveTheCommandsOfRun) {
  const std::string hash = hash_of_run();
  for (const std::vector<double>& lengths : odd_lengths) {
    Instance3 loop(*fmu);
    loop.initialize();
    step_by(lengths, step_s(), [&](double time_s, double size_s) {
      const Stepped stepped = loop.step(time_s, size_s);
      ASSERT_EQ(stepped.status, fmi3OK) << loop.messages();
      EXPECT_FALSE(stepped.early);
      EXPECT_EQ(stepped.time_s, time_s + size_s);
      EXPECT_EQ(loop.real("time"), stepped.time_s);
    });
    EXPECT_EQ(loop.text("trace_hash"), hash) << lengths.front();
    EXPECT_EQ(loop.step(periods * step_s(), 1e-17).status, fmi3OK) << "a remnant";
    EXPECT_EQ(loop.text("trace_hash"), hash);
  }
}

TEST_F(FmuInterface, OutputsHoldUntilACarrierPeriodEnds) {
  Instance3 loop(*fmu);
  loop.initialize();
  ASSERT_EQ(loop.step(0.0, 1.5 * step_s()).status, fmi3OK);
  const double displacement_m = loop.real("displacement_m");
  const std::string hash = loop.text("trace_hash");
  ASSERT_EQ(loop.step(1.5 * step_s(), 0.48 * step_s()).status, fmi3OK);
  EXPECT_EQ(loop.real("displacement_m"), displacement_m);
  EXPECT_EQ(loop.text("trace_hash"), hash);
  ASSERT_EQ(loop.step(1.98 * step_s(), 0.02 * step_s()).status, fmi3OK);
  EXPECT_NE(loop.real("displacement_m"), displacement_m);
  EXPECT_NE(loop.text("trace_hash"), hash);
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
