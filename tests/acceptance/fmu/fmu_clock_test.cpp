/// FMUs with event mode and a clock: who ticks plant and controller gets the commands of `run`, bit
/// for bit, and calls in any other order are refused.
///
/// The order of the calls is that of the FMI 3.0 specification, sections 2.2.8, 2.3.5 and 4.2.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/acceptance/fmu/importer/description_rules.hpp"
#include "tests/acceptance/fmu/importer/fmu3.hpp"
#include "tests/acceptance/program/program.hpp"
#include "tests/common/scenes.hpp"

namespace sonoglide::acceptance::fmu_clock_test {
namespace {

using Names = std::vector<std::string>;

constexpr int periods = 120;

const std::string scene = table_1_closed_loop + R"([run]
duration_s = 2e-3
[controller]
arithmetic = "float32"
target_friction_ratio = [[0.0, 0.4], [1e-3, 0.6]]
[sensor]
seed = 3
)";

/// What the scenes here are made of.
struct Fmus {
  explicit Fmus(const std::string& words) : words_(words) {
    folder.write("scene.toml", scene);
    plant = make("plant");
    controller = make("controller");
  }

  std::unique_ptr<Fmu3> make(const std::string& kind) const {
    make_fmu(folder, words_, "--clock --kind " + kind, kind);
    return std::make_unique<Fmu3>(folder, kind);
  }

  std::string hash_of_run(const std::string& words) const {
    const Outcome ran = folder.run("run " + words + " --json --set 'run.record=[]'");
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return nlohmann::json::parse(ran.out)["control"]["trace_hash"];
  }

  ScratchFolder folder;
  std::unique_ptr<Fmu3> plant;
  std::unique_ptr<Fmu3> controller;
  std::unique_ptr<Fmu3> loop;  ///< where a test makes it

 private:
  std::string words_;
};

Names inputs_of(const Fmu3& fmu) {
  Names names;
  for (const auto& [type, variable] : fmu.description().root().get_child("ModelVariables")) {
    if (attribute_of(variable, "causality") == "input" && type != "Clock") {
      names.push_back(attribute_of(variable, "name"));
    }
  }
  return names;
}

/// A master of one plant and one controller.
class Master {
 public:
  explicit Master(const Fmus& fmus)
      : plant(*fmus.plant),
        controller(*fmus.controller),
        measured_(inputs_of(*fmus.controller)),
        step_s_(fmus.plant->description().step_s()) {
    measured_.erase(measured_.end() - 1);  // the target
    plant.initialize();
    controller.initialize();
  }

  /// In event mode: the values go round, and are taken over.
  void tick() {
    begin_tick();
    end_tick();
  }
  void begin_tick() {
    for (Instance3* each : {&plant, &controller}) {
      ASSERT_EQ(each->set_clock(true), fmi3OK) << each->messages();
      EXPECT_TRUE(each->clock());
    }
    for (const std::string& name : measured_) {
      ASSERT_EQ(controller.set(name, plant.real(name)), fmi3OK) << controller.messages();
    }
    ASSERT_EQ(plant.set("drive_force_amplitude_N", controller.real("drive_force_amplitude_N")),
              fmi3OK)
        << plant.messages();
  }
  void end_tick() {
    for (Instance3* each : {&plant, &controller}) {
      ASSERT_EQ(each->update_discrete_states(), fmi3OK) << each->messages();
      EXPECT_FALSE(each->clock());
    }
  }
  /// From event mode to event mode, one carrier period later.
  void step() {
    for (Instance3* each : {&plant, &controller}) {
      ASSERT_EQ(each->enter_step_mode(), fmi3OK) << each->messages();
      const Stepped stepped = each->step(each->real("time"), step_s_);
      ASSERT_EQ(stepped.status, fmi3OK) << each->messages();
      EXPECT_EQ(stepped.time_s, each->real("time"));
      ASSERT_EQ(each->enter_event_mode(), fmi3OK) << each->messages();
    }
  }

  Instance3 plant;
  Instance3 controller;

 private:
  Names measured_;
  double step_s_;
};

class FmuClock : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    fmus = new Fmus("scene.toml");
    fmus->loop = fmus->make("loop");
  }
  static void TearDownTestSuite() { delete fmus; }

  static std::string hash_of_run() { return fmus->hash_of_run("scene.toml"); }
  static double step_s() { return fmus->loop->description().step_s(); }

  static Fmus* fmus;
};

Fmus* FmuClock::fmus = nullptr;

/// One period, from event mode to event mode.
void run_period(Instance3& loop, double step_s) {
  ASSERT_EQ(loop.set_clock(true), fmi3OK) << loop.messages();
  ASSERT_EQ(loop.update_discrete_states(), fmi3OK);
  ASSERT_EQ(loop.enter_step_mode(), fmi3OK);
  ASSERT_EQ(loop.step(loop.real("time"), step_s).status, fmi3OK) << loop.messages();
  ASSERT_EQ(loop.enter_event_mode(), fmi3OK);
}

void last_tick(Instance3& loop) {
  ASSERT_EQ(loop.set_clock(true), fmi3OK) << loop.messages();
  ASSERT_EQ(loop.update_discrete_states(), fmi3OK);
}

TEST_F(FmuClock, PlantAndControllerThatTickTogetherGiveTheHashOfRun) {
  Master master(*fmus);
  for (int k = 0; k < periods; ++k) {
    master.tick();
    master.step();
  }
  master.tick();
  EXPECT_EQ(master.controller.text("trace_hash"), hash_of_run());
}

TEST_F(FmuClock, TwoMastersInterleavedDoNotDisturbEachOther) {
  Master one(*fmus);
  Master other(*fmus);
  for (int k = 0; k < periods; ++k) {
    one.begin_tick();
    if (k > 0) {
      other.tick();
      other.step();
    }
    one.end_tick();
    one.step();
  }
  one.tick();
  EXPECT_EQ(one.controller.text("trace_hash"), hash_of_run());
  EXPECT_NE(other.controller.text("trace_hash"), hash_of_run());
  other.tick();
  other.step();
  // The first tick of `other` was one period late.
  other.tick();
  EXPECT_EQ(other.controller.text("trace_hash"), hash_of_run());
}

TEST_F(FmuClock, AStateFromTheMiddleOfATickGoesOnToTheSameHash) {
  std::vector<std::uint8_t> states[2];
  Master first(*fmus);
  for (int k = 0; k < periods; ++k) {
    first.begin_tick();
    if (k == periods / 2) {
      states[0] = first.plant.serialized_state();
      states[1] = first.controller.serialized_state();
    }
    first.end_tick();
    first.step();
  }
  Master second(*fmus);
  second.plant.restore(states[0]);
  second.controller.restore(states[1]);
  EXPECT_TRUE(second.controller.clock());
  second.end_tick();
  for (int k = periods / 2; k < periods; ++k) {
    second.step();
    second.tick();
  }
  EXPECT_EQ(second.controller.text("trace_hash"), hash_of_run());
}

TEST_F(FmuClock, ALoopThatTicksGivesTheHashOfRun) {
  Instance3 loop(*fmus->loop);
  loop.initialize();
  for (int k = 0; k < periods; ++k) {
    run_period(loop, step_s());
  }
  last_tick(loop);
  EXPECT_EQ(loop.text("trace_hash"), hash_of_run());
  EXPECT_EQ(SONOGLIDE_CALL3(loop, fmi3Terminate)(loop.get()), fmi3OK);
}

TEST_F(FmuClock, TheControllerAnswersInTheTickAndTheLastInputsCount) {
  Master master(*fmus);
  Instance3& controller = master.controller;
  int others = 0;
  std::string before = controller.text("trace_hash");
  for (int k = 0; k < periods; ++k) {
    master.begin_tick();
    const double force_N = controller.real("mean_friction_force_N");
    const std::string answered = controller.text("trace_hash");
    ASSERT_EQ(controller.set("mean_friction_force_N", 0.5 * force_N), fmi3OK);
    others += controller.text("trace_hash") != answered ? 1 : 0;
    ASSERT_EQ(controller.set("mean_friction_force_N", force_N), fmi3OK);
    EXPECT_EQ(controller.text("trace_hash"), answered);
    ASSERT_EQ(controller.set_clock(false), fmi3OK);
    EXPECT_EQ(controller.text("trace_hash"), before) << "the tick was taken back";
    ASSERT_EQ(controller.set_clock(true), fmi3OK);
    EXPECT_EQ(controller.text("trace_hash"), answered);
    before = answered;
    master.end_tick();
    master.step();
  }
  EXPECT_GT(others, 0);
  master.tick();
  EXPECT_EQ(controller.text("trace_hash"), hash_of_run());
}

TEST_F(FmuClock, CallsInAWrongOrderAreRefusedAndChangeNothing) {
  Instance3 loop(*fmus->loop);
  const auto refused = [&loop](fmi3Status status, const std::string& reason) {
    EXPECT_EQ(status, fmi3Error) << reason;
    EXPECT_NE(loop.messages().find("3 logStatusError: " + reason), std::string::npos)
        << loop.messages();
  };
  refused(loop.enter_event_mode(), "to enter event mode is not allowed before initialization");
  refused(loop.set_clock(true), "to set the clock is not allowed before initialization");
  ASSERT_EQ(loop.enter(), fmi3OK);
  refused(loop.set_clock(true), "to set the clock is not allowed in initialization mode");
  refused(loop.update_discrete_states(),
          "to update discrete states is not allowed in initialization mode");
  ASSERT_EQ(loop.set("target_friction_ratio", 0.0), fmi3OK);
  ASSERT_EQ(loop.exit(), fmi3OK);
  for (int k = 0; k < periods; ++k) {
    refused(loop.enter_step_mode(),
            "to enter step mode is not allowed before fmi3UpdateDiscreteStates");
    refused(loop.enter_event_mode(), "to enter event mode is not allowed in event mode");
    refused(loop.step(loop.real("time"), step_s()).status, "a step is not allowed in event mode");
    refused(loop.set("target_friction_ratio", 0.9), "target_friction_ratio belongs to the clock");
    ASSERT_EQ(loop.set_clock(true), fmi3OK) << loop.messages();
    refused(loop.enter_step_mode(),
            "to enter step mode is not allowed before fmi3UpdateDiscreteStates");
    ASSERT_EQ(loop.update_discrete_states(), fmi3OK);
    refused(loop.set_clock(true), "the clock has ticked at ");
    refused(loop.set("target_friction_ratio", 0.9), "target_friction_ratio belongs to the clock");
    ASSERT_EQ(loop.enter_step_mode(), fmi3OK);
    refused(loop.set_clock(true), "to set the clock is not allowed in step mode");
    refused(loop.enter_step_mode(), "to enter step mode is not allowed in step mode");
    EXPECT_EQ(loop.step(loop.real("time"), 2.0 * step_s()).status, fmi3Discard);
    EXPECT_EQ(loop.step(loop.real("time"), 0.5 * step_s()).status, fmi3Discard);
    ASSERT_EQ(loop.step(loop.real("time"), step_s()).status, fmi3OK) << loop.messages();
    refused(loop.step(loop.real("time"), step_s()).status, "the clock has not ticked at ");
    ASSERT_EQ(loop.enter_event_mode(), fmi3OK);
  }
  // Event mode that no clock ticks in changes nothing.
  ASSERT_EQ(loop.update_discrete_states(), fmi3OK);
  ASSERT_EQ(loop.enter_step_mode(), fmi3OK);
  ASSERT_EQ(loop.enter_event_mode(), fmi3OK);
  last_tick(loop);
  EXPECT_EQ(loop.text("trace_hash"), hash_of_run());
  EXPECT_NE(loop.messages().find("allowed: the clock's interval, 1.6666666666666667e-05 s"),
            std::string::npos);
}

TEST_F(FmuClock, TheIntervalIsAFractionAndConstant) {
  Instance3 loop(*fmus->loop);
  ASSERT_EQ(loop.enter(), fmi3OK);
  const unsigned clock = fmus->loop->description().reference("carrier_clock");
  fmi3IntervalQualifier qualifier = fmi3IntervalChanged;
  double interval_s = 0.0;
  double shift_s = 1.0;
  std::uint64_t counter = 0;
  std::uint64_t resolution = 0;
  EXPECT_EQ(
      SONOGLIDE_CALL3(loop, fmi3GetIntervalDecimal)(loop.get(), &clock, 1, &interval_s, &qualifier),
      fmi3OK);
  EXPECT_EQ(interval_s, 1.0 / 60000.0);
  EXPECT_EQ(qualifier, fmi3IntervalUnchanged);
  EXPECT_EQ(SONOGLIDE_CALL3(loop, fmi3GetIntervalFraction)(loop.get(), &clock, 1, &counter,
                                                           &resolution, &qualifier),
            fmi3OK);
  EXPECT_EQ(counter, 1U);
  EXPECT_EQ(resolution, 60000U);
  EXPECT_EQ(qualifier, fmi3IntervalUnchanged);
  EXPECT_EQ(SONOGLIDE_CALL3(loop, fmi3GetShiftDecimal)(loop.get(), &clock, 1, &shift_s), fmi3OK);
  EXPECT_EQ(shift_s, 0.0);
  EXPECT_EQ(
      SONOGLIDE_CALL3(loop, fmi3GetShiftFraction)(loop.get(), &clock, 1, &counter, &resolution),
      fmi3OK);
  EXPECT_EQ(counter, 0U);
  EXPECT_EQ(resolution, 60000U);
  EXPECT_EQ(SONOGLIDE_CALL3(loop, fmi3SetIntervalDecimal)(loop.get(), &clock, 1, &interval_s),
            fmi3Error);
  EXPECT_EQ(SONOGLIDE_CALL3(loop, fmi3SetShiftDecimal)(loop.get(), &clock, 1, &shift_s), fmi3Error);
  const unsigned time = fmus->loop->description().reference("time");
  EXPECT_EQ(SONOGLIDE_CALL3(loop, fmi3GetShiftDecimal)(loop.get(), &time, 1, &shift_s), fmi3Error);
  EXPECT_NE(loop.messages().find("time is no Clock"), std::string::npos);
}

void note(fmi3InstanceEnvironment told, fmi3Status status, fmi3String category,
          fmi3String message) {
  *static_cast<std::string*>(told) += std::to_string(status) + " " + category + ": " + message;
}

TEST_F(FmuClock, WhoDoesNotUseEventModeGetsNoInstance) {
  std::string told;
  auto* const make = fmus->loop->library().function<decltype(fmi3InstantiateCoSimulation)>(
      "fmi3InstantiateCoSimulation");
  EXPECT_EQ(make("tested", fmus->loop->description().attribute("instantiationToken").c_str(),
                 fmus->loop->resources().c_str(), false, true, false, false, nullptr, 0, &told,
                 note, nullptr),
            nullptr);
  EXPECT_EQ(told,
            "3 logStatusError: this FMU has a clock; allowed: eventModeUsed = true, or an FMU "
            "without one");
}

TEST_F(FmuClock, WhatHasNoClockIsRefused) {
  const auto refused = [&](const std::string& options, const std::string& message) {
    const Outcome outcome =
        fmus->folder.run("fmu scene.toml --clock --kind loop --out a.fmu " + options);
    EXPECT_EQ(outcome.exit_code, 2) << options;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
  };
  refused("--fmi 2", "--clock: is of FMI 3 alone; allowed: --fmi 3");
  refused("--set drive.frequency_Hz=60000.5",
          "drive.frequency_Hz: is 60000.5, and the interval of a clock is a fraction of whole "
          "numbers; allowed with a clock: a whole number of Hz");
}

/// The references in a list such as `clocks` and `dependencies`.
std::set<std::string> references_in(const Tree& element, const std::string& attribute) {
  std::istringstream list(attribute_of(element, attribute));
  return {std::istream_iterator<std::string>(list), {}};
}

/// Sections 2.2.8 and 2.4.7 of FMI 3.0.
void check_clock(const Description& description) {
  const Tree& root = description.root();
  check_description(root, false);
  EXPECT_EQ(description.stepping("hasEventMode"), "true");
  EXPECT_EQ(description.stepping("canHandleVariableCommunicationStepSize"), "false");
  const Tree& clock = description.variable("carrier_clock");
  for (const auto& [name, value] :
       std::map<std::string, std::string>{{"causality", "input"},
                                          {"variability", "discrete"},
                                          {"intervalVariability", "constant"},
                                          {"intervalDecimal", "1.6666666666666667e-05"},
                                          {"shiftDecimal", "0"},
                                          {"supportsFraction", "true"},
                                          {"resolution", "60000"},
                                          {"intervalCounter", "1"},
                                          {"shiftCounter", "0"},
                                          {"clocks", ""},
                                          {"unit", ""}}) {
    EXPECT_EQ(attribute_of(clock, name), value) << name;
  }
  const std::string reference = attribute_of(clock, "valueReference");
  std::set<std::string> inputs = {reference};
  std::map<std::string, bool> outputs;  // whether they are clocked
  int clocks = 0;
  for (const auto& [type, variable] : root.get_child("ModelVariables")) {
    clocks += type == "Clock" ? 1 : 0;
    const std::string each = attribute_of(variable, "valueReference");
    const std::string causality = attribute_of(variable, "causality");
    const std::set<std::string> named = references_in(variable, "clocks");
    EXPECT_TRUE(named.empty() || named == std::set<std::string>{reference}) << each;
    if (causality == "input") {
      inputs.insert(each);
      EXPECT_EQ(named.empty(), type == "Clock") << each;
    } else if (causality == "output") {
      outputs[each] = !named.empty();
    } else {
      EXPECT_TRUE(named.empty()) << "clocked variables are discrete";
    }
  }
  EXPECT_EQ(clocks, 1);
  std::set<std::string> listed;
  std::set<std::string> initial;
  for (const auto& [name, element] : root.get_child("ModelStructure")) {
    const std::string each = attribute_of(element, "valueReference");
    ASSERT_EQ(outputs.count(each), 1U) << "every output is there";
    EXPECT_TRUE((name == "Output" ? listed : initial).insert(each).second) << "once";
    if (name == "Output") {
      const std::set<std::string> dependencies = references_in(element, "dependencies");
      EXPECT_EQ(dependencies.count(reference) == 1, outputs[each]) << each;
      EXPECT_TRUE(
          std::includes(inputs.begin(), inputs.end(), dependencies.begin(), dependencies.end()))
          << each;
    } else {
      EXPECT_FALSE(outputs[each]) << "clocked variables have their first value at a tick";
    }
  }
  EXPECT_EQ(listed.size(), outputs.size());
  EXPECT_EQ(initial.size() + static_cast<std::size_t>(
                                 std::count_if(outputs.begin(), outputs.end(),
                                               [](const auto& output) { return output.second; })),
            outputs.size());
}

TEST_F(FmuClock, ItsDescriptionKeepsTheRules) {
  for (const Fmu3* fmu : {fmus->plant.get(), fmus->controller.get(), fmus->loop.get()}) {
    SCOPED_TRACE(fmu->description().stepping("modelIdentifier"));
    check_clock(fmu->description());
  }
}

/// If a plant's measured values depended on its drive in the same tick, whoever connects it to a
/// controller would see an algebraic loop.
TEST_F(FmuClock, OnlyTheControllersAnswersDependOnInputsOfTheSameTick) {
  const auto dependencies = [](const Fmu3& fmu, const std::string& output) {
    const std::string reference = std::to_string(fmu.description().reference(output));
    for (const auto& [name, element] : fmu.description().root().get_child("ModelStructure")) {
      if (name == "Output" && attribute_of(element, "valueReference") == reference) {
        return references_in(element, "dependencies").size();
      }
    }
    return std::size_t{0};
  };
  EXPECT_EQ(dependencies(*fmus->plant, "mean_friction_force_N"), 1U) << "the clock";
  EXPECT_EQ(dependencies(*fmus->plant, "displacement_m"), 0U);
  EXPECT_EQ(dependencies(*fmus->controller, "drive_force_amplitude_N"), 4U) << "and all inputs";
  EXPECT_EQ(dependencies(*fmus->loop, "mean_friction_force_N"), 1U);
  EXPECT_EQ(dependencies(*fmus->loop, "drive_force_amplitude_N"), 2U) << "and the target";
}

/// An example scene whose vibration is observed.
TEST(FmuClockDamped, TheVibrationGoesToTheControllerInTheTickToo) {
  const std::string words = SONOGLIDE_SCENES "/damped_step.toml --set run.duration_s=2e-3";
  const Fmus fmus(words);
  ASSERT_EQ(inputs_of(*fmus.controller).size(), 5U);
  Master master(fmus);
  const auto summary = nlohmann::json::parse(
      fmus.folder.run("run " + words + " --json --set 'run.record=[]' --set run.record_interval_s=")
          .out);
  const double frequency_Hz = summary["scene"]["drive"]["frequency_Hz"];
  const int count = static_cast<int>(2e-3 * frequency_Hz + 1e-6);
  for (int k = 0; k < count; ++k) {
    master.tick();
    master.step();
  }
  master.tick();
  EXPECT_EQ(master.controller.text("trace_hash"), summary["control"]["trace_hash"]);
}

}  // namespace
}  // namespace sonoglide::acceptance::fmu_clock_test
