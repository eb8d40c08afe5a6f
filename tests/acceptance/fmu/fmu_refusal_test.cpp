/// What an FMU refuses: it logs why, answers error, and nothing has changed.

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "tests/acceptance/fmu/importer/fmu2.hpp"
#include "tests/acceptance/fmu/importer/one_loop.hpp"

namespace sonoglide::acceptance::fmu_refusal_test {
namespace {

using one_loop::periods;

class FmuRefusal : public one_loop::OneLoop {};

TEST_F(FmuRefusal, WhatIsNoStepIsRefusedAndChangesNothing) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinite = std::numeric_limits<double>::infinity();
  Instance3 loop(*fmu);
  loop.initialize();
  for (const double part : {0.0, -1.0, -1e-12, nan, infinite, 1e13}) {
    EXPECT_EQ(loop.step(0.0, part * step_s()).status, fmi3Error) << part;
  }
  EXPECT_NE(loop.messages().find("3 logStatusError: the communication step is 0 s; allowed: above "
                                 "0 s"),
            std::string::npos)
      << loop.messages();
  for (const double point_s : {5.0 * step_s(), -step_s(), nan, infinite}) {
    EXPECT_EQ(loop.step(point_s, step_s()).status, fmi3Error) << point_s;
  }
  EXPECT_NE(loop.messages().find("the communication point is"), std::string::npos);
  ASSERT_EQ(loop.step(0.0, periods * step_s()).status, fmi3OK);
  EXPECT_EQ(loop.text("trace_hash"), hash_of_run());
}

TEST_F(FmuRefusal, AStartTimeFromWhichNothingCanBeCountedIsRefused) {
  make_fmu(*folder, "scene.toml", "--kind loop --fmi 2", "loop2");
  const Fmu2 fmu2(*folder, "loop2");
  for (const double start_s :
       {std::numeric_limits<double>::quiet_NaN(), 1e12, std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity()}) {
    Instance3 loop(*fmu);
    EXPECT_EQ(loop.enter(start_s), fmi3Error) << start_s;
    EXPECT_NE(loop.messages().find("the start time is"), std::string::npos) << loop.messages();
    EXPECT_EQ(loop.enter(-1e6), fmi3OK) << "another may follow";
    Instance2 loop2(fmu2);
    EXPECT_EQ(SONOGLIDE_CALL2(loop2, fmi2SetupExperiment)(loop2.get(), 0, 0.0, start_s, 0, 0.0),
              fmi2Error)
        << start_s;
  }
}

TEST_F(FmuRefusal, AStepPastTheStopTimeIsRefused) {
  constexpr double start_s = 0.25;
  const double stop_s = start_s + periods * step_s();
  for (const double wrong_s : {std::numeric_limits<double>::quiet_NaN(), start_s - step_s()}) {
    EXPECT_EQ(Instance3(*fmu).enter(start_s, wrong_s), fmi3Error) << wrong_s;
  }
  Instance3 loop(*fmu);
  ASSERT_EQ(loop.enter(start_s, stop_s), fmi3OK) << loop.messages();
  ASSERT_EQ(loop.exit(), fmi3OK);
  EXPECT_EQ(loop.step(start_s, (periods + 1.1) * step_s()).status, fmi3Error);
  EXPECT_NE(loop.messages().find("set as the stop time"), std::string::npos) << loop.messages();
  ASSERT_EQ(loop.step(start_s, periods * step_s()).status, fmi3OK) << loop.messages();
  EXPECT_EQ(loop.text("trace_hash"), hash_of_run()) << "the refused step changes nothing";
  Instance3 restored(*fmu);
  restored.restore(loop.serialized_state());
  for (Instance3* each : {&loop, &restored}) {
    EXPECT_EQ(each->step(stop_s, 2.0 * step_s()).status, fmi3Error);
    EXPECT_EQ(each->step(stop_s, step_s()).status, fmi3OK) << "as whoever adds up steps may do";
  }

  make_fmu(*folder, "scene.toml", "--kind loop --fmi 2", "loop2");
  const Fmu2 fmu2(*folder, "loop2");
  Instance2 loop2(fmu2);
  const auto set_up = SONOGLIDE_CALL2(loop2, fmi2SetupExperiment);
  EXPECT_EQ(set_up(loop2.get(), 0, 0.0, start_s, 1, start_s - step_s()), fmi2Error);
  ASSERT_EQ(set_up(loop2.get(), 0, 0.0, start_s, 1, stop_s), fmi2OK);
  ASSERT_EQ(SONOGLIDE_CALL2(loop2, fmi2EnterInitializationMode)(loop2.get()), fmi2OK);
  ASSERT_EQ(SONOGLIDE_CALL2(loop2, fmi2ExitInitializationMode)(loop2.get()), fmi2OK);
  EXPECT_EQ(loop2.step(start_s, (periods + 1.1) * step_s()), fmi2Error);
  EXPECT_EQ(loop2.step(start_s, periods * step_s()), fmi2OK) << loop2.messages();
}

TEST_F(FmuRefusal, NullPointersAreRefused) {
  Instance3 loop(*fmu);
  loop.initialize();
  const unsigned place = fmu->description().reference("friction_ratio");
  double value = 0.0;
  bool flag = false;
  const char* const* none = nullptr;
  EXPECT_EQ(SONOGLIDE_CALL3(loop, fmi3GetFloat64)(loop.get(), nullptr, 1, &value, 1), fmi3Error);
  EXPECT_EQ(SONOGLIDE_CALL3(loop, fmi3GetFloat64)(loop.get(), &place, 1, nullptr, 1), fmi3Error);
  EXPECT_EQ(SONOGLIDE_CALL3(loop, fmi3GetFloat64)(loop.get(), nullptr, 0, nullptr, 0), fmi3OK);
  EXPECT_EQ(SONOGLIDE_CALL3(loop, fmi3SetFloat64)(loop.get(), nullptr, 1, nullptr, 1), fmi3Error);
  EXPECT_EQ(SONOGLIDE_CALL3(loop, fmi3GetString)(loop.get(), nullptr, 1, nullptr, 1), fmi3Error);
  EXPECT_EQ(SONOGLIDE_CALL3(loop, fmi3GetFMUState)(loop.get(), nullptr), fmi3Error);
  EXPECT_EQ(SONOGLIDE_CALL3(loop, fmi3SetFMUState)(loop.get(), nullptr), fmi3Error);
  EXPECT_EQ(SONOGLIDE_CALL3(loop, fmi3SerializedFMUStateSize)(loop.get(), nullptr, nullptr),
            fmi3Error);
  EXPECT_EQ(SONOGLIDE_CALL3(loop, fmi3DeserializeFMUState)(loop.get(), nullptr, 100, nullptr),
            fmi3Error);
  EXPECT_EQ(SONOGLIDE_CALL3(loop, fmi3GetNumberOfVariableDependencies)(loop.get(), place, nullptr),
            fmi3Error);
  EXPECT_EQ(SONOGLIDE_CALL3(loop, fmi3SetDebugLogging)(loop.get(), true, 1, none), fmi3Error);
  EXPECT_EQ(SONOGLIDE_CALL3(loop, fmi3DoStep)(loop.get(), 0.0, step_s(), true, &flag, &flag, &flag,
                                              nullptr),
            fmi3Error);
  EXPECT_NE(loop.messages().find("a pointer is null"), std::string::npos);
  EXPECT_EQ(SONOGLIDE_CALL3(loop, fmi3Terminate)(nullptr), fmi3Error);
}

TEST_F(FmuRefusal, WhatTheFmuHasNotLogsAndAnswersError) {
  Instance3 loop(*fmu);
  loop.initialize();
  std::size_t count = 0;
  const unsigned place = 0;
  bool flags[5] = {};
  double time_s = 0.0;
  EXPECT_EQ(SONOGLIDE_CALL3(loop, fmi3EnterEventMode)(loop.get()), fmi3Error);
  EXPECT_EQ(SONOGLIDE_CALL3(loop, fmi3EnterStepMode)(loop.get()), fmi3Error);
  EXPECT_EQ(SONOGLIDE_CALL3(loop, fmi3UpdateDiscreteStates)(
                loop.get(), &flags[0], &flags[1], &flags[2], &flags[3], &flags[4], &time_s),
            fmi3Error);
  EXPECT_NE(loop.messages().find("event mode: this FMU has none"), std::string::npos);
  EXPECT_EQ(SONOGLIDE_CALL3(loop, fmi3GetNumberOfContinuousStates)(loop.get(), &count), fmi3Error);
  EXPECT_EQ(SONOGLIDE_CALL3(loop, fmi3GetNumberOfEventIndicators)(loop.get(), &count), fmi3Error);
  EXPECT_EQ(SONOGLIDE_CALL3(loop, fmi3SetTime)(loop.get(), 0.0), fmi3Error);
  EXPECT_NE(loop.messages().find("model exchange: this FMU has none"), std::string::npos);
  EXPECT_EQ(SONOGLIDE_CALL3(loop, fmi3ActivateModelPartition)(loop.get(), place, 0.0), fmi3Error);
  EXPECT_EQ(SONOGLIDE_CALL3(loop, fmi3GetClock)(loop.get(), &place, 1, &flags[0]), fmi3Error);
  EXPECT_NE(loop.messages().find("clocks: this FMU has none"), std::string::npos);
  ASSERT_EQ(loop.step(0.0, periods * step_s()).status, fmi3OK) << "and changes nothing";
  EXPECT_EQ(loop.text("trace_hash"), hash_of_run());
}

TEST_F(FmuRefusal, AParameterOutOfRangeIsNamedWithItsPlaceAndCanBeMended) {
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

TEST_F(FmuRefusal, WhatIsNotThereIsRefusedByName) {
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

TEST_F(FmuRefusal, DamagedAndForeignStatesAreRefused) {
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

}  // namespace
}  // namespace sonoglide::acceptance::fmu_refusal_test
