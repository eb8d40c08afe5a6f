/// A terminal on a unit, line by line.
#include "firmware/app/console.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "firmware/app/timed_loop.hpp"
#include "tests/app/unit/simulated_unit.hpp"

namespace sonoglide::app {
namespace {

/// From reset to the next reset; the flash outlives it.
class Terminal {
 public:
  explicit Terminal(SimulatedFlash& flash) : unit(field_design, flash) { greeting = type(""); }

  void serve(int periods) {
    for (int i = 0; i < periods; ++i) {
      loop_.serve();
    }
  }

  /// What the unit answers to what is typed.
  std::string type(const std::string& text) {
    wire.to_unit.insert(wire.to_unit.end(), text.begin(), text.end());
    while (!wire.to_unit.empty()) {
      serve(100);
    }
    serve(1500);
    const std::string answer(wire.from_unit.begin(), wire.from_unit.end());
    wire.from_unit.clear();
    return answer;
  }
  std::string line(const std::string& text) { return type(text + "\r\n"); }

  std::string greeting;
  TestedUnit unit;
  TimedBoard board;
  CountingWatchdog watchdog;
  Wire wire;

 private:
  using Service = Console<TestedUnit, Wire>;

  Service service_{unit, wire};
  TimedLoop<TestedUnit::Supervisor, TimedBoard, CountingWatchdog, Service> loop_{
      unit.supervisor(), board, watchdog, service_};
};

class ConsoleTest : public testing::Test {
 protected:
  SimulatedFlash flash;
  Terminal terminal{flash};
};

/// An answer without what changes from period to period.
std::string steady(const std::string& answer) {
  return answer.substr(0, answer.find(", period"));
}

TEST_F(ConsoleTest, GreetsAfterAReset) {
  EXPECT_EQ(terminal.greeting, "\r\nsonoglide\r\n");
}

TEST_F(ConsoleTest, StatusNamesWhatTheUnitDoes) {
  terminal.serve(300);
  // A ratio of 0.4 takes an amplitude of 0.1 / sin(0.2 pi) = 0.17013.
  EXPECT_EQ(terminal.line("status").substr(0, 40), "state running, target 0.4, drive 0.17013");
}

TEST_F(ConsoleTest, ATargetIsSetOrItsRangeNamed) {
  EXPECT_EQ(steady(terminal.line("target 0.45")).substr(0, 27), "state running, target 0.45,");
  terminal.serve(300);
  EXPECT_NEAR(terminal.board.ratio(), 0.45, 1e-3);
  for (const char* wrong : {"target 1.1", "target -1", "target nan", "target 0.4.5"}) {
    EXPECT_EQ(terminal.line(wrong), "target: allowed is 0 to 1\r\n") << wrong;
  }
  EXPECT_EQ(terminal.unit.target(), 450000U);
}

TEST_F(ConsoleTest, StopAndRestart) {
  EXPECT_EQ(steady(terminal.line("stop")),
            "state off, target 0.4, drive 0, limit none, fault none, parameters blank");
  terminal.serve(10);
  EXPECT_EQ(terminal.board.latest_drive().amplitude, 0);
  EXPECT_EQ(steady(terminal.line("restart")).substr(0, 17), "state calibrating");
  terminal.serve(300);
  EXPECT_NEAR(terminal.board.ratio(), 0.4, 1e-3);
}

TEST_F(ConsoleTest, FaultsAreListedTheLatestFirst) {
  EXPECT_EQ(terminal.line("faults"), "faults since reset: 0\r\n");
  terminal.board.fresh = false;
  terminal.serve(1);
  const std::string missing = std::to_string(terminal.unit.supervisor().periods());
  terminal.board.fresh = true;
  terminal.line("restart");
  terminal.board.step_takes = 1;
  terminal.serve(1);
  const std::string late = std::to_string(terminal.unit.supervisor().periods());
  EXPECT_EQ(terminal.line("faults"), "period " + late + ": overrun\r\nperiod " + missing +
                                         ": measurement_missing\r\nfaults since reset: 2\r\n");
  EXPECT_NE(terminal.line("status").find("state fault, "), std::string::npos);
  EXPECT_NE(terminal.line("status").find("fault overrun, "), std::string::npos);
}

TEST_F(ConsoleTest, ParametersAreListedWithTheirRanges) {
  EXPECT_EQ(terminal.line("params"),
            "target 0.4, compiled in 0.4; allowed is 0 to 1\r\n"
            "drive_limit 1, compiled in 1; allowed is 0 to 1\r\n"
            "gain_scale 1, compiled in 1; allowed is 0 to 1\r\n"
            "friction_force 0.5, compiled in 0.5; allowed is 0.000977 to 1\r\n"
            "speed_floor 0.01, compiled in 0.01; allowed is 0.0001 to 1\r\n"
            "stuck_periods 10, compiled in 10; allowed is 10 to 65535\r\n");
}

TEST_F(ConsoleTest, AParameterIsSavedAndKeptOverAReset) {
  EXPECT_EQ(terminal.line("set drive_limit 0.8"), "stop the drive first\r\n");
  terminal.line("stop");
  EXPECT_EQ(terminal.line("set drive_limit 0.8"), "drive_limit 0.8, saved\r\n");
  EXPECT_EQ(terminal.line("set stuck_periods 20"), "stuck_periods 20, saved\r\n");
  Terminal after(flash);
  EXPECT_NE(after.line("params").find("drive_limit 0.8, compiled in 1"), std::string::npos);
  EXPECT_NE(after.line("status").find("parameters stored"), std::string::npos);
}

TEST_F(ConsoleTest, WhatCannotBeSetIsNamed) {
  terminal.line("stop");
  EXPECT_EQ(terminal.line("set drive_limit 2"), "drive_limit: allowed is 0 to 1\r\n");
  EXPECT_EQ(terminal.line("set drive_limit x"), "drive_limit: allowed is 0 to 1\r\n");
  EXPECT_EQ(terminal.line("set stuck_periods 9"), "stuck_periods: allowed is 10 to 65535\r\n");
  EXPECT_EQ(terminal.line("set stuck_periods 10.5"), "stuck_periods: allowed is 10 to 65535\r\n");
  EXPECT_EQ(terminal.line("set drive 1"), "unknown; params lists what there is\r\n");
  EXPECT_EQ(terminal.line("set drive_limits 1"), "unknown; params lists what there is\r\n");
  EXPECT_EQ(flash.operations(), 0);
  flash.wear_out();
  EXPECT_EQ(terminal.line("set drive_limit 0.8"), "drive_limit 1 stands; not saved\r\n");
}

TEST_F(ConsoleTest, OtherLinesGetTheListOfCommands) {
  const std::string list =
      "unknown; there are: status, target RATIO, stop, restart, faults, params, set NAME VALUE\r\n";
  for (const char* wrong : {"help", "Status", "status now", "target", "target 0.4 0.5", "set",
                            "set target", "set target 0.4 0.5", "stop stop", "sto", "stopp"}) {
    EXPECT_EQ(terminal.line(wrong), list) << wrong;
  }
}

TEST_F(ConsoleTest, EmptyLinesAreNotAnsweredAndBlanksNotCounted) {
  EXPECT_EQ(terminal.type("\r\n\n\r   \r\n"), "");
  EXPECT_EQ(terminal.type("  faults  \n"), "faults since reset: 0\r\n");
}

TEST_F(ConsoleTest, ALineThatIsTooLongIsNotCarriedOut) {
  const std::string answer = "the line is too long\r\n";
  terminal.line(std::string(28, ' ') + "stop");
  EXPECT_FALSE(terminal.unit.supervisor().driving());
  terminal.line("restart");
  EXPECT_EQ(terminal.line(std::string(29, ' ') + "stop"), answer);
  EXPECT_EQ(terminal.line("stop" + std::string(500, ' ')), answer);
  EXPECT_TRUE(terminal.unit.supervisor().driving());
  EXPECT_EQ(terminal.line("faults"), "faults since reset: 0\r\n");
}

bool is_whole_lines(const std::string& text) {
  return text.empty() || (text.size() > 1 && text.substr(text.size() - 2) == "\r\n");
}

RC_GTEST_PROP(ConsoleAnswerTest, AnyTextIsAnsweredInWholeLines, ()) {
  SimulatedFlash flash;
  Terminal terminal(flash);
  const std::vector<std::string> words{
      "status", "target", "stop", "restart", "faults", "params",     "set", " ",
      "0.45",   "2",      "\r\n", "\n",      "target", "gain_scale", " ",   "\n"};
  const auto text = rc::gen::oneOf(rc::gen::elementOf(words), rc::gen::arbitrary<std::string>());
  std::string typed;
  for (const std::string& part : *rc::gen::container<std::vector<std::string>>(text)) {
    typed += part;
  }
  const std::string answer = terminal.line(typed);
  RC_ASSERT(is_whole_lines(answer));
  RC_ASSERT(std::all_of(answer.begin(), answer.end(),
                        [](char c) { return c == '\r' || c == '\n' || (' ' <= c && c <= '~'); }));
  RC_ASSERT(!flash.misused());
  RC_ASSERT(terminal.watchdog.feeds == static_cast<int>(terminal.unit.supervisor().periods()));
}

}  // namespace
}  // namespace sonoglide::app
