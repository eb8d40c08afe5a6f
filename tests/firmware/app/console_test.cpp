/// A terminal on a unit, line by line.
#include "firmware/app/console.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "firmware/app/timed_loop.hpp"
#include "tests/firmware/app/unit/simulated_unit.hpp"

namespace sonoglide::app::console_test {
namespace {

constexpr FieldDesign<Parts> console_design(designed, 0.2F, 1, carrier_period_s,
                                            timeout_of_console);

/// From reset to the next reset; the flash outlives it.
class Terminal {
 public:
  explicit Terminal(SimulatedFlash& flash, const FieldDesign<Parts>& design = console_design)
      : unit(design, flash) {
    greeting = type("");
  }

  void serve(int periods) {
    for (int i = 0; i < periods; ++i) {
      loop_.serve();
    }
  }

  void put(const std::string& text) {
    wire.to_unit.insert(wire.to_unit.end(), text.begin(), text.end());
  }

  /// What the unit answers to what is typed, until it falls silent.
  std::string type(const std::string& text) {
    put(text);
    while (!wire.to_unit.empty()) {
      serve(100);
    }
    std::size_t before = 0;
    do {
      before = wire.from_unit.size();
      serve(2000);
    } while (wire.from_unit.size() > before);
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

/// A unit that was told to drive.
class ConsoleTest : public testing::Test {
 protected:
  ConsoleTest() { terminal.line("restart"); }

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

TEST(ConsolePowerOn, TheDriveIsOffUntilToldUnlessThatIsStored) {
  SimulatedFlash flash;
  Terminal terminal(flash);
  EXPECT_EQ(steady(terminal.line("status")),
            "state off, target 0.4, drive 0, limit none, fault none, parameters blank");
  EXPECT_EQ(terminal.line("set start_on_power 1"), "start_on_power 1, saved\r\n");
  Terminal after(flash);
  EXPECT_EQ(after.line("status").substr(0, 27), "state running, target 0.4, ");
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
            "stuck_periods 10, compiled in 10; allowed is 10 to 65535\r\n"
            "start_on_power 0, compiled in 0; allowed is 0 to 1\r\n"
            "host_timeout 0, compiled in 0; allowed is 0 to 60 s\r\n"
            "bad_samples 0, compiled in 0; allowed is 0 to 31\r\n");
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
      "unknown; there are: status, target RATIO, stop, restart, confirm, faults, params, set NAME "
      "VALUE\r\n";
  for (const char* wrong :
       {"help", "Status", "status now", "target", "target 0.4 0.5", "set", "set target",
        "set target 0.4 0.5", "stop now", "sto", "stopp", "confirm it"}) {
    EXPECT_EQ(terminal.line(wrong), list) << wrong;
  }
}

TEST_F(ConsoleTest, EmptyLinesAreNotAnsweredAndBlanksNotCounted) {
  EXPECT_EQ(terminal.type("\r\n\n\r   \r\n"), "");
  EXPECT_EQ(terminal.type("  faults  \n"), "faults since reset: 0\r\n");
}

TEST_F(ConsoleTest, ALineThatIsTooLongIsNotCarriedOut) {
  const std::string answer =
      "not done: the line is too long, it came too fast, or a fault came first\r\n";
  terminal.line(std::string(22, ' ') + "target 0.5");
  EXPECT_EQ(terminal.unit.target(), 500000U);
  EXPECT_EQ(terminal.line(std::string(23, ' ') + "target 0.6"), answer);
  EXPECT_EQ(terminal.line("target 0.6" + std::string(500, ' ')), answer);
  EXPECT_EQ(terminal.unit.target(), 500000U);
  EXPECT_EQ(terminal.line("faults"), "faults since reset: 0\r\n");
}

/// Everything that is answered, or is a save.
const std::vector<std::string> busy_with{"status", "faults", "params",     "target 2",
                                         "help",   "set x",  "target 0.5", std::string(99, 'x')};

void expect_stopped_within(Terminal& terminal, std::size_t characters, const std::string& what,
                           int when) {
  terminal.serve(static_cast<int>(characters));
  ASSERT_FALSE(terminal.unit.supervisor().driving()) << what << " after " << when;
  terminal.serve(1);
  ASSERT_EQ(terminal.board.latest_drive().amplitude, 0) << what << " after " << when;
}

/// Periods from the line to a little after the last character of its answer; 1200 for longer ones.
int periods_of_answer(const std::string& line) {
  SimulatedFlash flash;
  Terminal terminal(flash);
  terminal.unit.restart();
  terminal.put(line + "\r");
  int last = 0;
  for (int period = 0; period < 1200; ++period) {
    const std::size_t before = terminal.wire.from_unit.size();
    terminal.serve(1);
    last = terminal.wire.from_unit.size() > before ? period : last;
  }
  return std::min(last + 50, 1200);
}

// "stop" comes so many periods after another line: with each of its characters, and with each of
// its answer's, shown to somebody or to nobody.
TEST(ConsoleStop, ActsWithItsLastCharacterWhateverIsBeingAnswered) {
  for (const std::string& line : busy_with) {
    const int answered = periods_of_answer(line);
    for (const bool shown : {true, false}) {
      for (int when = 0; when < answered; when += line == "params" ? 7 : 1) {
        SimulatedFlash flash;
        Terminal terminal(flash);
        terminal.unit.restart();
        terminal.wire.blocked = !shown;
        terminal.put(line + "\r");
        terminal.serve(when);
        const std::size_t in_front = terminal.wire.to_unit.size();
        terminal.put("stop\r");
        expect_stopped_within(terminal, in_front + 5, line, when);
        if (when % 10 == 0) {
          terminal.wire.blocked = false;
          EXPECT_NE(terminal.type("").find("state off, "), std::string::npos) << when;
        }
        ASSERT_FALSE(terminal.unit.supervisor().driving());
      }
    }
  }
}

TEST(ConsoleStop, OvertakesARestartThatWaitsInEveryPhaseOfASave) {
  for (const char* saving : {"set gain_scale 0.5\r", "confirm\r"}) {
    for (int when = 0; when < 200; ++when) {
      SimulatedFlash flash;
      Terminal terminal(flash);
      terminal.put(std::string(saving) + "restart\r");
      terminal.serve(when);
      const std::size_t in_front = terminal.wire.to_unit.size();
      terminal.put("stop\r");
      expect_stopped_within(terminal, in_front + 5, saving, when);
      EXPECT_NE(terminal.type("").find("state off, "), std::string::npos) << when;
      ASSERT_FALSE(terminal.unit.supervisor().driving());
      ASSERT_FALSE(flash.misused());
    }
  }
}

constexpr const char* not_done =
    "not done: the line is too long, it came too fast, or a fault came first\r\n";

// With every character of the second restart, while it waits, and after it.
TEST(ConsoleFault, CancelsARestartThatWasTypedBeforeIt) {
  const std::string first = "restart\r\n";
  const std::string both = first + "restart\r\n";
  int cancelled = 0;
  for (int when = static_cast<int>(first.size()) + 1; when < 400; ++when) {
    SimulatedFlash flash;
    Terminal terminal(flash);
    terminal.put(both);
    terminal.serve(when);
    terminal.board.fresh = false;
    terminal.serve(1);
    terminal.board.fresh = true;
    const std::string answer = terminal.type("");
    ASSERT_EQ(terminal.board.latest_drive().state, static_cast<std::uint8_t>(control::State::fault))
        << when;
    ASSERT_EQ(terminal.board.latest_drive().amplitude, 0) << when;
    ASSERT_EQ(terminal.unit.supervisor().faults().count(), 1U) << when;
    const bool said = answer.find(not_done) != std::string::npos;
    cancelled += said ? 1 : 0;
    // Carried out before the fault or cancelled by it: one answer for each line.
    ASSERT_EQ(std::count(answer.begin(), answer.end(), '\n'), 2) << when << ": " << answer;
  }
  EXPECT_GT(cancelled, 50);
}

TEST(ConsoleFault, WithNothingTypedSaysNothing) {
  SimulatedFlash flash;
  Terminal terminal(flash);
  terminal.line("restart");
  terminal.board.fresh = false;
  terminal.serve(1);
  terminal.board.fresh = true;
  EXPECT_EQ(terminal.type(""), "");
  EXPECT_EQ(terminal.line("status").substr(0, 11), "state fault");
  EXPECT_EQ(terminal.line("restart").substr(0, 17), "state calibrating");
}

TEST_F(ConsoleTest, AStopActsBehindAnyFragment) {
  for (const std::string before : {"", "  ", "tar", "stostop", "ss", "set gain_scale ", "\x80\xff",
                                   "restart\rrestart\r", "stop"}) {
    ASSERT_TRUE(terminal.unit.supervisor().driving()) << before;
    const std::string answer = terminal.line(before + "stop  ");
    EXPECT_FALSE(terminal.unit.supervisor().driving()) << before;
    EXPECT_NE(answer.find("state off, "), std::string::npos) << before;
    terminal.line("restart");
  }
  terminal.line(std::string(500, 'x') + "stop");
  EXPECT_FALSE(terminal.unit.supervisor().driving());
}

TEST_F(ConsoleTest, LinesTypedAheadWaitTheirTurn) {
  const std::string answer = terminal.type("faults\rtarget 0.45\rstatus\rtarget 2\r");
  EXPECT_EQ(answer.substr(0, 23), "faults since reset: 0\r\n");
  EXPECT_NE(answer.find("target 0.45, "), std::string::npos);
  EXPECT_EQ(answer.substr(answer.size() - 27), "target: allowed is 0 to 1\r\n");
}

/// Blank lines, which are kept and not answered.
std::string blank_lines(std::size_t characters) {
  std::string lines = characters % 2 == 1 ? "  \r" : "";
  while (lines.size() < characters) {
    lines += " \r";
  }
  return lines;
}

// What is cut off is not carried out in part: 0.95 is not 0.9.
TEST_F(ConsoleTest, ALineThatDoesNotWaitInFullIsLostAndThatIsSaid) {
  for (std::size_t blank = 30; blank < 90; ++blank) {
    terminal.line("target 0.4");
    terminal.put("params\r");
    terminal.serve(40);
    const std::string answer = terminal.type(blank_lines(blank) + "target 0.95\rtarget 0.94\r");
    const std::uint32_t expected = blank <= 62 - 24 ? 940000 : blank <= 62 - 12 ? 950000 : 400000;
    EXPECT_EQ(terminal.unit.target(), expected) << blank;
    EXPECT_EQ(answer.find(not_done) != std::string::npos, expected != 940000);
    EXPECT_EQ(terminal.line("faults"), "faults since reset: 0\r\n");
  }
}

// However many there are: they take no room.
TEST_F(ConsoleTest, EmptyLinesCostNoLineThatFollows) {
  terminal.put("params\r");
  terminal.serve(40);
  terminal.type(std::string(200, '\n') + "target 0.95\r\n\r\ntarget 0.94\r\n");
  EXPECT_EQ(terminal.unit.target(), 940000U);
}

TEST_F(ConsoleTest, WhereAHostTimeoutIsSetEveryCharacterIsLife) {
  terminal.line("stop");
  EXPECT_EQ(terminal.line("set host_timeout 0.1"), "host_timeout 0.1, saved\r\n");
  terminal.put("restart\r");
  for (int i = 0; i < 5; ++i) {
    terminal.serve(5000);
    terminal.put("x");
  }
  terminal.serve(5990);
  EXPECT_EQ(terminal.board.latest_drive().state,
            static_cast<std::uint8_t>(control::State::running));
  terminal.serve(200);
  EXPECT_NE(terminal.line("").find(not_done), std::string::npos);
  EXPECT_NE(terminal.line("status").find("state fault, target 0.4, drive 0, limit none, fault "
                                         "host_silent, parameters stored"),
            std::string::npos);
  EXPECT_EQ(terminal.line("restart").substr(0, 17), "state calibrating");
}

TEST(ConsoleParameters, ThatWereLostAreNamedAndHoldTheUnitOffUntilConfirmedOrSet) {
  for (const char* told : {"confirm", "set drive_limit 0.2"}) {
    SimulatedFlash flash;
    flash.page(0).fill(0);
    Terminal terminal(flash);
    EXPECT_EQ(steady(terminal.line("status")),
              "state fault, target 0.4, drive 0, limit none, fault parameters_lost, parameters "
              "damaged");
    EXPECT_EQ(terminal.line("restart"), "see params, then confirm them or set one\r\n");
    EXPECT_EQ(terminal.line(told),
              told[0] == 'c' ? "parameters confirmed, saved\r\n" : "drive_limit 0.2, saved\r\n");
    EXPECT_EQ(terminal.line("restart").substr(0, 17), "state calibrating");
    EXPECT_NE(terminal.line("status").find("parameters stored"), std::string::npos);
    EXPECT_EQ(terminal.line("confirm"), "stop the drive first\r\n");
  }
}

TEST(ConsoleParameters, OfAnotherDesignAreNamed) {
  SimulatedFlash flash;
  Terminal(flash).line("set drive_limit 0.2");
  static constexpr FieldDesign<Parts> other(designed, 0.2F, 2, carrier_period_s,
                                            timeout_of_console);
  Terminal terminal(flash, other);
  EXPECT_EQ(steady(terminal.line("status")),
            "state fault, target 0.4, drive 0, limit none, fault parameters_of_other_design, "
            "parameters other_design");
  EXPECT_NE(terminal.line("params").find("drive_limit 0.2, compiled in 1;"), std::string::npos);
  flash.wear_out();
  EXPECT_EQ(terminal.line("confirm"), "parameters confirmed until reset; not saved\r\n");
  EXPECT_EQ(terminal.line("restart").substr(0, 17), "state calibrating");
}

bool is_whole_lines(const std::string& text) {
  return text.empty() || (text.size() > 1 && text.substr(text.size() - 2) == "\r\n");
}

TEST_F(ConsoleTest, LongAnswersInARowAreWaitedFor) {
  const std::string answer = terminal.line("a\na\na\na\na\nparams\na");
  EXPECT_EQ(answer.substr(answer.size() - 12), "NAME VALUE\r\n");
}

RC_GTEST_PROP(ConsoleAnswerTest, AnyTextIsAnsweredInWholeLines, ()) {
  SimulatedFlash flash;
  Terminal terminal(flash);
  const std::vector<std::string> words{
      "status", "target", "stop", "restart", "faults", "params",     "set", " ", "confirm",
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
}  // namespace sonoglide::app::console_test
