/// A person at the host program and a unit at the other end of a serial device.
#include "host_sim/boards/unit/console.hpp"
#include "host_sim/process/regular_expression.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "firmware/app/history.hpp"
#include "firmware/app/link_service.hpp"
#include "firmware/app/timed_loop.hpp"
#include "firmware/link/trace_messages.hpp"
#include "host_sim/boards/unit/unit_link.hpp"
#include "host_sim/boards/unit/unit_scales.hpp"
#include "host_sim/boards/unit/unit_words.hpp"
#include "host_sim/process/serial_port.hpp"
#include "tests/common/csv/csv.hpp"
#include "tests/firmware/app/unit/simulated_unit.hpp"
#include "tests/host_sim/boards/unit/terminal/pseudo_terminal.hpp"

namespace sonoglide::unit::console_test {
namespace {

using Lines = std::vector<std::string>;

/// Serves a piece of a device's work again and again, on a thread.
class Device {
 public:
  explicit Device(std::function<void()> serve)
      : thread_([this, serve = std::move(serve)] {
          while (!over_) {
            serve();
          }
        }) {}
  ~Device() {
    over_ = true;
    thread_.join();
  }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

 private:
  std::atomic<bool> over_{false};
  std::thread thread_;
};

constexpr std::size_t steps_kept = 200;

/// Of a friction ratio.
struct RatioDesign {
  using Parts = app::Parts;
  static constexpr app::FieldDesign<Parts> design{app::designed,         0.2F, 1, app::full_scales,
                                                  app::carrier_period_s, 0};
};

/// Of a friction force: the controller of RatioDesign with another target.
struct ForceDesign {
  using Parts =
      control::Parts<float, control::TrustedFriction<float>, control::CoulombFeedforward<float>,
                     control::NoSlewLimit<float>, control::NoShaping<float>,
                     control::IntegralRegulator<float, 1>, control::NoRelearning<float>,
                     control::FedForward<float>, control::ForceSensor, control::ForceTarget<float>>;
  static constexpr control::Controller<Parts>::Parameters designed = [] {
    control::Controller<Parts>::Parameters parameters{};
    parameters.friction_force = app::designed.friction_force;
    parameters.smallest_friction = app::designed.smallest_friction;
    parameters.speed_floor = app::designed.speed_floor;
    parameters.regulator = app::designed.regulator;
    parameters.standstill = app::designed.standstill;
    parameters.stuck = app::designed.stuck;
    parameters.plausibility = app::designed.plausibility;
    parameters.watch = app::designed.watch;
    parameters.target = {true};
    return parameters;
  }();
  static constexpr link::FullScales full_scales = [] {
    link::FullScales scales = app::full_scales;
    scales[0] = {link::ScaleUnit::newton, 0.03924};
    scales[3] = scales[0];
    return scales;
  }();
  static constexpr app::FieldDesign<Parts> design{
      designed, 0.25F, 1, full_scales, app::carrier_period_s, 0};
};

/// A unit that is served as fast as the machine can, and so has no time of its own.
template <class Design, class Board = app::TimedBoard, class Product = app::TestedProduct>
class ServedUnit {
 public:
  explicit ServedUnit(const PseudoTerminal& terminal) : link_(terminal) {}

  Board& board() { return board_; }

 private:
  using Unit = app::Unit<typename Design::Parts, app::SimulatedFlash, std::atomic, steps_kept>;
  app::SimulatedFlash flash_;
  Unit unit_{Design::design, flash_};
  Board board_;
  app::CountingWatchdog watchdog_;
  TerminalLink link_;
  using Service = app::LinkService<Unit, TerminalLink, 32, Product>;
  Service service_{unit_, link_};
  app::TimedLoop<typename Unit::Supervisor, Board, app::CountingWatchdog, Service> loop_{
      unit_.supervisor(), board_, watchdog_, service_};
  Device served_{[this] {
    loop_.serve();
    board_.in_force.clear();
  }};
};

constexpr auto target_parameter = static_cast<std::size_t>(app::Parameter::target);
constexpr auto friction_parameter = static_cast<std::size_t>(app::Parameter::friction_force);
constexpr auto limit_parameter = static_cast<std::size_t>(app::Parameter::drive_limit);

// At resonance the drive of either phase has an amplitude of either sign.
TEST(UnitScalesTest, ACodeOfEitherSignIsAPartOfItsFullScale) {
  const UnitScales scales(app::full_scales);
  EXPECT_EQ(scales.text_of(link::Quantity::amplitude, 1U << 30), "960");
  EXPECT_EQ(scales.text_of(link::Quantity::amplitude, 0U - (1U << 30)), "-960");
  EXPECT_EQ(scales.text_of(link::Quantity::amplitude, 0x80000000U), "-1920");
  EXPECT_EQ(scales.value_of(link::Quantity::friction_force, 12345678U), 12345678 * 0x1p-31 * 0.04);
}

TEST(UnitScalesTest, ColumnsHaveTheNamesOfPeriodsCsv) {
  const UnitScales ratio(app::full_scales);
  EXPECT_EQ(ratio.column_of(link::Quantity::friction_force), "friction_force_N");
  EXPECT_EQ(ratio.column_of(link::Quantity::sliding_velocity), "sliding_velocity_m_per_s");
  EXPECT_EQ(ratio.column_of(link::Quantity::amplitude), "drive_amplitude_N");
  EXPECT_EQ(ratio.column_of(link::Quantity::target), "target");
  EXPECT_FALSE(ratio.has(link::Quantity::bias));
  link::FullScales full_scales = ForceDesign::full_scales;
  full_scales[2] = {link::ScaleUnit::volt, 150.0};
  full_scales[4] = {link::ScaleUnit::newton, 10.0};
  const UnitScales force(full_scales);
  EXPECT_EQ(force.column_of(link::Quantity::amplitude), "drive_amplitude_V");
  EXPECT_EQ(force.column_of(link::Quantity::target), "target_force_N");
  EXPECT_EQ(force.column_of(link::Quantity::bias), "bias_N");
}

// Every millionth, or every so many, of full scales of any size.
TEST(UnitScalesTest, AForceIsReadBackFromItsText) {
  for (const double full_scale_N : {0.03924, 1.0, 2.0 / 3.0, 7e-6, 12345.678}) {
    link::FullScales full_scales = ForceDesign::full_scales;
    full_scales[3].value = full_scale_N;
    const UnitScales scales(full_scales);
    EXPECT_TRUE(scales.is_force(target_parameter));
    for (std::uint32_t count = 0; count <= 1'000'000; count += count < 100 ? 1 : 997) {
      const std::string text = scales.text_of_parameter(target_parameter, count);
      ASSERT_EQ(scales.count_of_parameter(target_parameter, number_of(text)), count) << text;
      ASSERT_EQ(scales.target_of(count), number_of(text));
      ASSERT_NEAR(number_of(text), count * 1e-6 * full_scale_N, 0.501e-6 * full_scale_N);
    }
  }
}

TEST(UnitScalesTest, AForceThatWasOrderedIsShown) {
  const UnitScales scales(ForceDesign::full_scales);
  for (const char* text : {"0", "0.012", "0.01", "0.0123", "0.039", "0.03924", "0.0000001"}) {
    const std::uint32_t count = scales.count_of_parameter(target_parameter, number_of(text));
    EXPECT_EQ(scales.text_of_parameter(target_parameter, count), text);
  }
  EXPECT_EQ(scales.count_of_parameter(target_parameter, 1e30), UINT32_MAX);
  EXPECT_EQ(scales.count_of_parameter(target_parameter, -1.0), UINT32_MAX);
}

TEST(UnitScalesTest, WhatIsNoForceIsCountedInDecimalPlaces) {
  const UnitScales ratio(app::full_scales);
  EXPECT_FALSE(ratio.is_force(target_parameter));
  EXPECT_EQ(ratio.text_of_parameter(target_parameter, 450'000), "0.45");
  EXPECT_EQ(ratio.target_of(450'001), 0.450001);
  EXPECT_EQ(ratio.count_of_parameter(target_parameter, 0.45), 450'000U);
  EXPECT_TRUE(ratio.is_force(friction_parameter));
  EXPECT_EQ(ratio.text_of_parameter(friction_parameter, 500'000), "0.02");
  EXPECT_EQ(ratio.text_of_parameter(limit_parameter, 800'000), "0.8");
}

template <class Design, class Board = app::TimedBoard, class Product = app::TestedProduct>
class ConsoleOf : public testing::Test {
 protected:
  Lines ask(const std::string& line) { return console_.carry_out(line); }
  std::string line_of(const std::string& line) { return ask(line).at(0); }

  PseudoTerminal terminal_;
  ServedUnit<Design, Board, Product> served_{terminal_};
  process::SerialPort port_{terminal_.device()};
  UnitLink link_{port_};
  Console console_{link_};
};
using ConsoleTest = ConsoleOf<RatioDesign>;
using ForceConsole = ConsoleOf<ForceDesign>;

TEST_F(ConsoleTest, StartsStopsAndSaysHowTheUnitIs) {
  EXPECT_EQ(line_of("status").find("state off, target 0.4, drive 0 N, limit none, fault none, "
                                   "parameters blank, period "),
            0U);
  ask("restart");
  std::string status = line_of("status");
  for (int i = 0; i < 10 && status.find(", settled,") == std::string::npos; ++i) {
    status = line_of("status");
  }
  EXPECT_EQ(status.find("state running, target 0.4, drive 32"), 0U) << status;
  EXPECT_NE(status.find(", settled, nominal/true friction 1"), std::string::npos) << status;
  EXPECT_EQ(line_of("target 0.7").find("state running, target 0.7,"), 0U);
  EXPECT_EQ(line_of("set drive_limit 0.8"), "stop the drive first");
  EXPECT_EQ(line_of("stop").find("state off, target 0.7, drive 0 N,"), 0U);
  EXPECT_EQ(ask("log"), (Lines{"faults since reset: 0"}));
  EXPECT_EQ(console_.refused(), 1U);
}

struct ProductAfterAnException : app::TestedProduct {
  static constexpr hal::KeptException kept{3,        0x1234,   0x5679,    0x61000003,
                                           1U << 16, 1U << 30, 0x40000000};
  static inline const hal::KeptException* exception = &kept;
};
using ConsoleAfterAnException = ConsoleOf<RatioDesign, app::TimedBoard, ProductAfterAnException>;

TEST_F(ConsoleAfterAnException, LogEndsWithIt) {
  EXPECT_EQ(ask("log"),
            (Lines{"faults since reset: 0",
                   "exception 3 before the reset: program counter 0x00001234, link register "
                   "0x00005679, program status 0x61000003, fault status 0x00010000, hard fault "
                   "status 0x40000000, fault address 0x40000000"}));
}

/// In its 18th boot, 3 h and some after the first.
struct ProductWithHistory : app::TestedProduct {
  static app::UnitHistory<app::HistoryPages> of_boots(int boots) {
    app::CountingWatchdog watchdog;
    app::UnitHistory<app::HistoryPages> last(pages, watchdog, hal::ResetCause::watchdog,
                                             &ProductAfterAnException::kept, 1);
    last.serve(1, false);
    for (std::uint32_t second = 1; second < 11'045; ++second) {
      last.serve(second, false);
    }
    last.note_stop();
    for (int i = 0; i < 100; ++i) {
      last.serve(11'045, true);
    }
    for (int i = 2; i < boots; ++i) {
      app::UnitHistory<app::HistoryPages>(pages, watchdog, hal::ResetCause::watchdog, nullptr, 1);
    }
    return {pages, watchdog, hal::ResetCause::reset, nullptr, 60'000};
  }
  static inline app::SimulatedFlash flash;
  static inline app::HistoryPages pages{flash};
  static inline app::UnitHistory<app::HistoryPages> kept = of_boots(18);
  static inline app::UnitHistory<app::HistoryPages>* history = &kept;
};
using ConsoleOfAHistory = ConsoleOf<RatioDesign, app::TimedBoard, ProductWithHistory>;

TEST_F(ConsoleOfAHistory, TellsIt) {
  const Lines told = ask("history");
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told[0].find("boot 18, after a reset; in operation 3 h 4 min "), 0U) << told[0];
  EXPECT_NE(told[0].find(" s; boots after the watchdog 17, after an exception 1"),
            std::string::npos)
      << told[0];
  EXPECT_EQ(told[1].find("exception 3 before boot 1: program counter 0x00001234, "), 0U) << told[1];
  EXPECT_EQ(ask("log"), (Lines{"faults since reset: 0"}));
}

TEST(CauseName, HasWordsForEachCause) {
  Lines names;
  for (const hal::ResetCause cause :
       {hal::ResetCause::power_on, hal::ResetCause::reset, hal::ResetCause::watchdog,
        hal::ResetCause::exception, hal::ResetCause::crystal}) {
    names.emplace_back(cause_name(static_cast<std::uint8_t>(cause)));
  }
  EXPECT_EQ(names, (Lines{"power-on", "a reset", "a reset by the watchdog", "an exception",
                          "a failure of the crystal"}));
}

TEST_F(ConsoleTest, AUnitWithoutAHistorySaysSo) {
  EXPECT_EQ(ask("history"), (Lines{"the unit keeps no history"}));
  EXPECT_EQ(console_.refused(), 1U);
}

TEST_F(ConsoleTest, SaysWhatTheUnitIs) {
  EXPECT_EQ(ask("identity"),
            (Lines{fmt::format("test-stand, firmware 0.1.0, design {:#010x}, serial number 4711",
                               RatioDesign::design.design()),
                   "target: friction ratio, 0 to 1; full scale of force 0.04 N, velocity 5 m/s, "
                   "drive 1920 N, bias none; a step every 16.67 us"}));
}

TEST_F(ConsoleTest, StreamsTheChosenChannelsAsATable) {
  EXPECT_EQ(ask("stream state amplitude every 500"),
            (Lines{"number,period,drive_amplitude_N,state,limit,fault,settling"}));
  Lines rows;
  while (rows.size() < 20) {
    const Lines more = console_.take_rows();
    rows.insert(rows.end(), more.begin(), more.end());
    ask("status");
  }
  const process::RegularExpression pattern("([0-9]+),([0-9]+),0,off,none,none,pending");
  long last = -1;
  for (const std::string& row : rows) {
    const process::Match found = pattern.match(row);
    ASSERT_FALSE(found.empty()) << row;
    EXPECT_GT(std::stol(found[1]), last);
    last = std::stol(found[1]);
  }
  EXPECT_EQ(ask("stream off").back().find("stream off, samples lost: "), 0U);
  ask("status");
  EXPECT_EQ(console_.take_rows(), Lines{});
  EXPECT_EQ(console_.refused(), 0U);
  for (const char* wrong : {"stream", "stream speed", "stream target every 0", "stream every 5",
                            "stream target every", "stream target every 65536", "stream off off"}) {
    EXPECT_EQ(line_of(wrong),
              fmt::format("\"{}\": allowed: stream CHANNEL ... [every N], stream off; channels: "
                          "friction_force, sliding_velocity, amplitude, commanded_ratio, target, "
                          "state; N: 1 to 65535",
                          wrong));
  }
}

TEST_F(ConsoleTest, PlotsAChannelAsItComes) {
  ask("restart");
  EXPECT_EQ(
      ask("plot friction_force"),
      (Lines{fmt::format("    period          friction_force_N |{:<30}{:>30}|", "0", "0.04")}));
  Lines rows;
  while (rows.size() < 3) {
    const Lines more = console_.take_rows();
    rows.insert(rows.end(), more.begin(), more.end());
    ask("status");
  }
  // The contact's friction is a part of the full scale, and so is the place of its mark.
  const std::size_t frame = rows[2].find('|');
  const double force_N = std::stod(rows[2].substr(frame - 26, 25));
  EXPECT_NEAR(static_cast<double>(rows[2].find('*') - frame - 1), force_N / 0.04 * 59.0, 0.51)
      << rows[2];
  EXPECT_EQ(rows[2].size(), frame + 62);
  EXPECT_EQ(ask("stream off").back().find("stream off, samples lost: "), 0U);
  for (const char* wrong : {"plot state", "plot speed", "plot off"}) {
    EXPECT_EQ(line_of(wrong).find(fmt::format("\"{}\": allowed: plot CHANNEL; channels: ", wrong)),
              0U);
  }
}

TEST(LivePlotTest, WhatIsBeyondIsAtTheEdge) {
  const UnitScales scales(app::full_scales);
  const LivePlot velocity(link::Channel::sliding_velocity, scales);
  const LivePlot amplitude(link::Channel::amplitude, scales);
  const auto row = [](const LivePlot& plot, std::size_t channel, std::int32_t code) {
    link::Streamed sample{0, static_cast<std::uint8_t>(1U << channel), 7, {}};
    sample.values.at(channel) = static_cast<std::uint32_t>(code);
    const std::string text = plot.row(sample);
    return text.substr(text.find('|'));
  };
  EXPECT_EQ(row(velocity, 1, INT32_MIN), fmt::format("|*{:59}|", ""));
  EXPECT_EQ(row(velocity, 1, 0), fmt::format("|{:30}*{:29}|", "", ""));
  EXPECT_EQ(row(amplitude, 2, -1), fmt::format("|<{:59}|", ""));
  EXPECT_EQ(row(amplitude, 2, INT32_MAX), fmt::format("|{:59}*|", ""));
  EXPECT_EQ(velocity.stream().every, 6000);
}

class TraceConsole : public ConsoleTest {
 protected:
  ~TraceConsole() override { std::filesystem::remove(file_); }

  /// That the unit is in.
  unsigned long period() {
    const std::string status = line_of("status");
    return std::stoul(status.substr(status.find("period ") + 7));
  }

  /// Waits until the trace is whole, and saves it.
  csv::Table saved_trace() {
    std::string state = line_of("trace");
    for (int i = 0; i < 1000 && state.find("trace of") != 0; ++i) {
      state = line_of("trace");
    }
    const process::RegularExpression pattern(
        "trace of 200 steps from period ([0-9]+), triggered by ([a-z]+) in period ([0-9]+)");
    const process::Match found = pattern.match(state);
    if (found.empty()) {
      throw std::runtime_error(state);
    }
    first_ = std::stoul(found[1]);
    cause_ = found[2];
    trigger_ = std::stoul(found[3]) - first_;
    EXPECT_EQ(line_of("trace save " + file_), "200 steps saved");
    std::ifstream stream(file_);
    return csv::Table({std::istreambuf_iterator<char>(stream), {}}, file_);
  }

  std::string file_ = testing::TempDir() + "sonoglide_trace_" + std::to_string(getpid()) + ".csv";
  std::size_t first_ = 0;
  std::string cause_;
  std::size_t trigger_ = 0;
};

TEST_F(TraceConsole, SavesTheStepsAroundANewTarget) {
  EXPECT_EQ(line_of("trace"), "no trace");
  ask("restart");
  EXPECT_EQ(line_of("trace on target 30"), "trace waiting");
  const unsigned long armed = period();
  while (period() < armed + 30) {  // as many as are to be kept
    EXPECT_EQ(line_of("trace"), "trace waiting");
  }
  ask("target 0.7");
  const csv::Table table = saved_trace();
  EXPECT_EQ(cause_, "target");
  EXPECT_EQ(trigger_, 30U);
  EXPECT_EQ(table.columns(),
            (csv::Cells{"period", "friction_force_N", "sliding_velocity_m_per_s",
                        "drive_amplitude_N", "target", "state", "limit", "fault", "settling"}));
  ASSERT_EQ(table.rows().size(), steps_kept);
  for (std::size_t i = 0; i < steps_kept; ++i) {
    const csv::Row& row = table.rows()[i];
    EXPECT_EQ(row.number("period"), static_cast<double>(first_ + i));
    EXPECT_EQ(row.text("target"), i < 30 ? "0.4" : "0.7");
    EXPECT_EQ(row.text("fault"), "none");
    EXPECT_NEAR(row.number("sliding_velocity_m_per_s"), 5.0 * app::TimedBoard::speed, 1e-8);
  }
  const csv::Row& last = table.rows().back();
  EXPECT_NEAR(last.number("friction_force_N"), 0.04 * 0.7 * app::TimedBoard::friction, 4e-5);
  EXPECT_EQ(last.text("state"), "running");
  EXPECT_EQ(line_of("trace save " + file_), file_ + ": is there already; allowed: a new file");
  EXPECT_EQ(console_.refused(), 1U);
}

TEST_F(TraceConsole, SavesWhatComesNowAndNamesWhatThereIs) {
  EXPECT_EQ(line_of("trace save " + file_), "no trace: nothing to save");
  EXPECT_EQ(line_of("trace now"), "trace waiting");
  EXPECT_EQ(saved_trace().rows().front().text("state"), "off");
  EXPECT_EQ(cause_, "now");
  EXPECT_EQ(trigger_, 0U);
  EXPECT_EQ(line_of("trace on fault target 199"), "trace waiting");
  for (const char* wrong :
       {"trace on", "trace on fault 200", "trace on 5", "trace soon", "trace now 5",
        "trace on fault 5 target", "trace save", "trace on target -1"}) {
    EXPECT_EQ(line_of(wrong),
              fmt::format("\"{}\": allowed: trace, trace now, trace on fault|target "
                          "[STEPS_BEFORE], trace save FILE; STEPS_BEFORE: 0 to 199",
                          wrong));
  }
}

TEST_F(TraceConsole, MeasuresAStepAndSavesItsPage) {
  EXPECT_EQ(line_of("step 0.4 0.7"), "the drive is off: restart it first");
  ask("restart");
  const std::string page = file_ + " a b.html";
  const Lines lines =
      Console(link_, "the samples are of a dummy").carry_out("step 0.4 0.7 \"" + page + '"');
  EXPECT_EQ(lines.back(), "the samples are of a dummy");
  const std::string& told = lines.front();
  const process::Match found =
      process::RegularExpression("^the friction force goes from ([0-9.]+) mN to ([0-9.]+) mN")
          .search(told);
  ASSERT_FALSE(found.empty()) << told;
  constexpr double undriven_mN = 40.0 * app::TimedBoard::friction;
  EXPECT_NEAR(std::stod(found[1]), 0.4 * undriven_mN, 0.02 * undriven_mN);
  EXPECT_NEAR(std::stod(found[2]), 0.7 * undriven_mN, 0.02 * undriven_mN);
  EXPECT_NE(told.find(" of the step after "), std::string::npos) << told;
  std::ifstream stream(page);
  const std::string html{std::istreambuf_iterator<char>(stream), {}};
  std::filesystem::remove(page);
  EXPECT_NE(html.find("Step of a unit"), std::string::npos);
  EXPECT_NE(html.find("The samples are of a dummy."), std::string::npos);
  EXPECT_EQ(line_of("status").find("state running, target 0.7,"), 0U);
  EXPECT_EQ(console_.refused(), 1U);
}

TEST_F(TraceConsole, AStepThatCannotBeIsRefusedBeforeItIsDriven) {
  ask("restart");
  EXPECT_EQ(line_of("step 0.4 0.4"), "both targets are the same; allowed: two different ones");
  EXPECT_EQ(line_of("step 5000 6000"), "target: allowed is 0 to 1");
  EXPECT_EQ(line_of("step 0.4 0.7 \"x.html"),
            "step 0.4 0.7 \"x.html: a quotation mark is not closed");
  EXPECT_EQ(line_of("step 0.4 0.7 \"\""), "FILE: has no name; allowed: a new file");
  EXPECT_EQ(line_of("step 0.4 high"), "target: \"high\" is no number; allowed is 0 to 1");
  EXPECT_EQ(line_of("step 0.4 1.5"), "target: allowed is 0 to 1");
  EXPECT_EQ(line_of("step 0.4 0.5 /dev/null/x.csv"), "/dev/null: is a file, not a folder");
  EXPECT_EQ(line_of("status").find("state running, target 0.4,"), 0U);
}

TEST(StreamTableTest, CountsWhatIsLeftOutAndShowsCodesExactly) {
  const UnitScales scales(app::full_scales);
  StreamTable table(scales);
  EXPECT_EQ(table.begin({0x1B, 1}),
            "number,period,friction_force_N,sliding_velocity_m_per_s,commanded_ratio,target");
  EXPECT_EQ(table.row({65535, 0x1B, 7, {0x80000000, 1, 0, 0x40000000, 400000, 0}}),
            "65535,7,-0.04,2.3283064365386963e-09,1,0.4");
  EXPECT_EQ(table.lost(), 65535U);
  table.row({0, 0x1B, 8, {}});
  EXPECT_EQ(table.lost(), 65535U);
  table.row({3, 0x1B, 8, {}});
  EXPECT_EQ(table.lost(), 65537U);
}

TEST_F(ForceConsole, TakesAndTellsForcesInNewtons) {
  EXPECT_EQ(ask("identity").at(1),
            "target: friction force, 0 to 0.03924 N; full scale of force 0.03924 N, velocity 5 "
            "m/s, drive 1920 N, bias none; a step every 16.67 us");
  EXPECT_EQ(line_of("status").find("state off, target 0.00981 N, drive 0 N, limit"), 0U);
  EXPECT_EQ(line_of("target 0.012").find("state off, target 0.012 N, drive 0 N, limit"), 0U);
  EXPECT_EQ(line_of("target 0.01234567").find("state off, target 0.0123457 N,"), 0U);
  EXPECT_EQ(line_of("target 0.04"), "target: allowed is 0 to 0.03924 N");
  EXPECT_EQ(line_of("target -0.01"), "target: allowed is 0 to 0.03924 N");
  EXPECT_EQ(line_of("target x"), "target: \"x\" is no number; allowed is 0 to 0.03924 N");
  EXPECT_EQ(line_of("target"),
            "\"target\": allowed: target NUMBER; NUMBER: friction force, 0 to 0.03924 N");
  EXPECT_EQ(line_of("params target"),
            "target 0.00981 N, compiled in 0.00981 N; allowed is 0 to 0.03924 N");
  EXPECT_EQ(line_of("set target 0.015"), "target 0.015 N, saved");
  EXPECT_EQ(console_.refused(), 4U);
}

TEST_F(ForceConsole, StreamsAndHoldsAForceInNewtons) {
  ask("target 0.012");
  ask("restart");
  for (int i = 0; i < 20 && line_of("status").find(", settled,") == std::string::npos; ++i) {
  }
  EXPECT_EQ(ask("stream friction_force target every 500"),
            (Lines{"number,period,friction_force_N,target_force_N"}));
  Lines rows;
  while (rows.empty()) {
    rows = console_.take_rows();
    ask("status");
  }
  const process::RegularExpression pattern("[0-9]+,[0-9]+,([0-9.e-]+),0\\.012");
  const process::Match found = pattern.match(rows.back());
  ASSERT_FALSE(found.empty()) << rows.back();
  EXPECT_NEAR(std::stod(found[1]), 0.012, 1e-4);
}

TEST_F(ConsoleTest, ReadsAndWritesParametersByName) {
  const Lines all = ask("params");
  ASSERT_EQ(all.size(), app::parameter_count);
  EXPECT_EQ(all[1], "drive_limit 1, compiled in 1; allowed is 0 to 1");
  EXPECT_EQ(all[3], "friction_force 0.02 N, compiled in 0.02 N; allowed is 0.00003908 to 0.04 N");
  EXPECT_EQ(all[7], "host_timeout 0 s, compiled in 0 s; allowed is 0 to 60 s");
  EXPECT_EQ(all[9], "force_offset 0 N, compiled in 0 N; allowed is -0.01 to 0.01 N");
  EXPECT_EQ(all[10], "force_gain 1, compiled in 1; allowed is 0.5 to 1.5");
  EXPECT_EQ(line_of("set force_offset -0.0012"), "force_offset -0.0012 N, saved");
  EXPECT_EQ(line_of("set drive_limit 0.8"), "drive_limit 0.8, saved");
  EXPECT_EQ(ask("params drive_limit"),
            (Lines{"drive_limit 0.8, compiled in 1; allowed is 0 to 1"}));
  EXPECT_EQ(line_of("set host_timeout 0.25"), "host_timeout 0.25 s, saved");
  EXPECT_EQ(console_.refused(), 0U);
}

TEST_F(ConsoleTest, NamesWhatIsAllowed) {
  EXPECT_EQ(line_of("target 1.5"), "target: allowed is 0 to 1");
  EXPECT_EQ(line_of("target -0.5"), "target: allowed is 0 to 1");
  EXPECT_EQ(line_of("set host_timeout 61"), "host_timeout: allowed is 0 to 60 s");
  EXPECT_EQ(line_of("set stuck_periods 9"), "stuck_periods: allowed is 10 to 65535");
  EXPECT_EQ(line_of("set gain 1").find("unknown parameter; there are: target, drive_limit,"), 0U);
  EXPECT_EQ(line_of("params gain").find("unknown parameter; there are: target,"), 0U);
  EXPECT_EQ(
      line_of(" go  now "),
      "\"go now\": unknown; there are: identity, status, target, stop, restart, confirm, log, "
      "history, params, set, tare, stream, plot, trace, step, help");
  EXPECT_EQ(console_.refused(), 7U);
  EXPECT_EQ(ask("  "), Lines{});
}

TEST_F(ConsoleTest, ToldWhatACommandTakes) {
  EXPECT_EQ(line_of("target"),
            "\"target\": allowed: target NUMBER; NUMBER: friction ratio, 0 to 1");
  EXPECT_EQ(line_of("stop now"), "\"stop now\": allowed: stop");
  EXPECT_EQ(line_of("set"), "\"set\": allowed: set NAME VALUE");
  EXPECT_EQ(line_of("set a"), "\"set a\": allowed: set NAME VALUE; params lists the names");
  EXPECT_EQ(
      line_of("set force_offset 0.001 N"),
      "\"set force_offset 0.001 N\": allowed: set NAME VALUE; VALUE: a number alone, -0.01 to "
      "0.01 N");
  EXPECT_EQ(line_of("params a b"), "\"params a b\": allowed: params, params NAME");
  EXPECT_EQ(line_of("step 0.4 0.5 0.8"), "\"step 0.4 0.5 0.8\": allowed: step FROM TO [FILE]");
  EXPECT_EQ(console_.refused(), 7U);
}

TEST_F(ConsoleTest, HelpHasALineForEachCommand) {
  const Lines help = ask("help");
  EXPECT_EQ(help.size(), 16U);
  EXPECT_EQ(help.front(), "identity: board, firmware, design and full scales");
  EXPECT_EQ(help.back(), "help: this list");
  EXPECT_EQ(console_.refused(), 0U);
}

TEST_F(ConsoleTest, KnowsWhatIsNoNumber) {
  EXPECT_EQ(line_of("set drive_limit 0.8x"),
            "drive_limit: \"0.8x\" is no number; allowed is 0 to 1");
  EXPECT_EQ(line_of("set stuck_periods 20.5"),
            "stuck_periods: \"20.5\" is no whole number; allowed is 10 to 65535");
  EXPECT_EQ(line_of("target 0.1234567"),
            "target: \"0.1234567\" has more than 6 decimal places; allowed is 0 to 1");
  for (const std::string text : {"x", "-", ".", "1e-1", "0.5.1", "--1", "0,5"}) {
    EXPECT_EQ(line_of("target " + text),
              "target: \"" + text + "\" is no number; allowed is 0 to 1");
  }
  EXPECT_EQ(line_of("target 99999999999999999999"), "target: allowed is 0 to 1");
  EXPECT_EQ(line_of("target " + std::string(100000, '1')), "target: allowed is 0 to 1");
  EXPECT_EQ(line_of("target -0.000001"), "target: allowed is 0 to 1");
  EXPECT_EQ(console_.refused(), 13U);
  EXPECT_EQ(line_of("target -0").find("state off, target 0,"), 0U);
  EXPECT_EQ(line_of("target 0.50000000").find("state off, target 0.5,"), 0U);
  EXPECT_EQ(line_of("set stuck_periods 20.0"), "stuck_periods 20, saved");
  EXPECT_EQ(console_.refused(), 13U);
}

/// Its hardware holds the drive off.
struct TrippedBoard : app::TimedBoard {
  static std::uint8_t tripped() { return 1; }
};
using TrippedConsole = ConsoleOf<RatioDesign, TrippedBoard>;

TEST_F(TrippedConsole, ARestartIsRefusedWithItsReason) {
  EXPECT_EQ(line_of("restart"),
            "the board's hardware holds the drive off, status has its fault: remove the cause");
  EXPECT_NE(line_of("status").find(", fault external_1, "), std::string::npos);
  EXPECT_EQ(console_.refused(), 1U);
}

/// Its contact is lifted: the force sensor reads its offset and noise.
class LiftedBoard : public app::TimedBoard {
 public:
  bool sample(hal::Sample& sample) {
    const bool goes_on = app::TimedBoard::sample(sample);
    const double spread = std::uniform_real_distribution<double>(-1.0, 1.0)(random_);
    sample.friction_force = static_cast<std::int32_t>((offset + noise * spread) * 0x1p31);
    sample.sliding_velocity = static_cast<std::int32_t>(speed * 0x1p31);
    return goes_on;
  }

  // Parts of full scale.
  std::atomic<double> offset{0.03};
  std::atomic<double> noise{0.0};
  std::atomic<double> speed{0.0};

 private:
  std::mt19937 random_{1};
};
using LiftedConsole = ConsoleOf<RatioDesign, LiftedBoard>;

// The unit shows what its present offset and gain make of the reading, to 2.5e-5 of full scale.
TEST_F(LiftedConsole, ATareSavesTheOffsetThatTheSensorHas) {
  constexpr double error_N = 2.5e-5 * 0.04;
  const process::RegularExpression tared(
      "force_offset was (.+) N, is (.+) N, standard error 0 N; saved");
  ask("set force_gain 0.9");
  ask("set force_offset -0.002");
  double before_N = -0.002;
  for (const double offset : {0.03, 0.03, -0.2}) {
    served_.board().offset = offset;
    const Lines lines = ask("tare");
    ASSERT_EQ(lines.size(), 2U) << lines.front();
    const process::Match found = tared.match(lines.front());
    ASSERT_FALSE(found.empty()) << lines.front();
    EXPECT_EQ(lines.back(),
              "every one of 256 readings was the same: a sensor without noise, or one that is "
              "stuck; check that a force changes it: stream friction_force");
    EXPECT_EQ(std::stod(found[1]), before_N);
    before_N = std::stod(found[2]);
    EXPECT_NEAR(before_N, 0.04 * offset, error_N);
    EXPECT_EQ(line_of("params force_offset"),
              "force_offset " + found[2] + " N, compiled in 0 N; allowed is -0.01 to 0.01 N");
  }
  EXPECT_EQ(console_.refused(), 0U);
}

// 6e-4 of full scale are 4e-5 in the mean; allowed is 0.1 % of a friction of half the full scale.
TEST_F(LiftedConsole, ATareNeedsASteadyForce) {
  served_.board().noise = 1e-3;
  const Lines told = ask("tare");
  EXPECT_EQ(told.size(), 1U);  // nothing is to be said of readings that show noise
  const std::string& saved = told.front();
  const process::Match found =
      process::RegularExpression(
          "force_offset was 0 N, is ([0-9.]+) N, standard error ([0-9.]+) ([un])N; saved")
          .match(saved);
  ASSERT_FALSE(found.empty()) << saved;
  EXPECT_NEAR(std::stod(found[1]), 0.0012, 1e-5);
  // 1.44 uN. Its estimate of 15 degrees of freedom is within 0.3 to 2.2 of it but for one in a million.
  const double standard_error_N = std::stod(found[2]) * (found[3] == "u" ? 1e-6 : 1e-9);
  EXPECT_GT(standard_error_N, 0.3 * 1.44e-6);
  EXPECT_LT(standard_error_N, 2.2 * 1.44e-6);
  const std::string before = line_of("params force_offset");
  served_.board().noise = 0.2;
  const std::string refused = line_of("tare");
  const process::RegularExpression unsteady(
      "the force is not steady: the standard error of its mean is [0-9.]+ uN; "
      "allowed is up to 20 uN, 0.1 % of friction_force");
  EXPECT_FALSE(unsteady.match(refused).empty()) << refused;
  EXPECT_EQ(line_of("params force_offset"), before);
  EXPECT_EQ(console_.refused(), 1U);
}

TEST_F(LiftedConsole, ATareOutOfRangeChangesNothing) {
  served_.board().offset = 0.3;
  served_.board().noise = 1e-3;
  EXPECT_EQ(line_of("tare").find("force_offset would be 12"), 0U);
  served_.board().noise = 0.0;
  served_.board().offset = -1.0;
  EXPECT_EQ(line_of("tare"),
            "force_offset would be -40 mN; allowed is -0.01 to 0.01 N; every reading was the same, "
            "as of a converter at its rail or a sensor that is stuck");
  EXPECT_EQ(line_of("params force_offset").find("force_offset 0 N,"), 0U);
}

TEST_F(LiftedConsole, ATareNeedsAStopAndNoLoad) {
  served_.board().speed = 0.1;
  EXPECT_EQ(line_of("tare").find("force_offset was 0 N, is 0.0012 N,"), 0U);
  served_.board().offset = 0.03 + 0.3;
  EXPECT_EQ(
      line_of("tare"),
      "the contact slides at 500 mm/s under a friction of 12 mN: lift it, or let it stand still if it is lifted");
  served_.board().noise =
      1e-3;  // a sensor that stands still would be a fault while the unit drives
  ask("restart");
  EXPECT_EQ(line_of("tare"), "stop the drive first");
  EXPECT_EQ(line_of("tare now"), "\"tare now\": allowed: tare");
  EXPECT_EQ(line_of("params force_offset").find("force_offset 0.0012 N,"), 0U);
  EXPECT_EQ(console_.refused(), 3U);
}

// The sensor stands still, which the unit notices after some periods.
TEST_F(LiftedConsole, ATareInAFaultNamesIt) {
  served_.board().speed = 0.1;
  ask("restart");
  const auto is_fault = [this] {
    return line_of("status").find("fault measurement_stuck") != std::string::npos;
  };
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!is_fault()) {
    ASSERT_LT(std::chrono::steady_clock::now(), deadline) << line_of("status");
  }
  EXPECT_EQ(line_of("tare"),
            "the unit is in the fault measurement_stuck: remove its cause, and stop");
  ask("stop");
  EXPECT_EQ(line_of("tare").find("force_offset was 0 N, is 0.0012 N,"), 0U);
}

TEST_F(ConsoleTest, AStreamDoesNotOutliveItsHost) {
  ask("stream amplitude");  // by a host that ends without a word
  {
    UnitLink link(port_);
    Console console(link);
    for (int i = 0; i < 20; ++i) {
      console.carry_out("status");
      EXPECT_EQ(console.take_rows(), Lines{});
    }
    console.carry_out("stream amplitude");
    while (console.take_rows().empty()) {
      console.carry_out("status");
    }
  }
  using std::chrono_literals::operator""ms;
  std::uint8_t bytes[4096];
  int silent = 0;
  for (int i = 0; i < 1000 && silent < 5; ++i) {
    silent = port_.receive(bytes, sizeof bytes, 20ms) == 0 ? silent + 1 : 0;
  }
  EXPECT_EQ(silent, 5);
}

// Each host begins with a number of its own, and none is told what another one was told.
TEST_F(ConsoleTest, ANewHostFindsTheUnitThatAnOlderOneLeft) {
  ask("target 0.6");
  for (int i = 0; i < 5; ++i) {
    UnitLink link(port_);
    Console console(link);
    EXPECT_EQ(console.carry_out("status").at(0).find("state off, target 0.6,"), 0U);
  }
}

/// Answers the first copy of each request.
class FakeUnit {
 public:
  using Answer = std::function<link::Frame(const link::Frame&)>;

  /// @param answer  to a request
  FakeUnit(const PseudoTerminal& terminal, Answer answer)
      : link_(terminal), answer_(std::move(answer)) {}

 private:
  void serve() {
    std::uint8_t byte = 0;
    if (link_.receive(byte) && decoder_.take(byte) == link::Reception::frame &&
        last_ != decoder_.frame().sequence) {
      last_ = decoder_.frame().sequence;
      const link::WireFrame wire = link::encode(answer_(decoder_.frame()));
      for (std::size_t i = 0; i < wire.size; ++i) {
        link_.send(wire.bytes[i]);
      }
    }
  }

  TerminalLink link_;
  Answer answer_;
  link::FrameDecoder decoder_;
  std::optional<std::uint16_t> last_;
  Device served_{[this] { serve(); }};
};

link::Frame refused_as_unknown(const link::Frame& request) {
  const auto unknown = static_cast<std::uint8_t>(link::Reason::unknown_request);
  return link::frame_of(link::Refusal{request.kind, unknown, 0, 0}, request.sequence);
}

// It refuses the number of the new host by the last one of the old host. Either answer comes in the
// third try.
TEST(UnitLinkTest, IsPatientWithASlowUnitThatAnotherHostHasLeft) {
  const PseudoTerminal terminal;
  bool refused = false;
  const FakeUnit unit(terminal, [&](const link::Frame& request) {
    const std::uint16_t number = request.sequence;
    link::Hello hello{};
    if (!link::read(request, hello)) {
      return refused_as_unknown(request);
    }
    std::this_thread::sleep_for(5 * UnitLink::usual_patience / 2);
    const auto out_of_turn = static_cast<std::uint8_t>(link::Reason::out_of_turn);
    const std::uint32_t last = static_cast<std::uint16_t>(number + 7);
    return std::exchange(refused, true)
               ? link::frame_of(link::Greeted{hello.session, 0}, number)
               : link::frame_of(link::Refusal{0x01, out_of_turn, last, last}, number);
  });
  process::SerialPort port(terminal.device());
  EXPECT_NO_THROW(UnitLink link(port));
}

// What a trace holds takes long to come over the line.
TEST(SaveTest, APlaceThatCannotBeWrittenIsToldBeforeTheTraceIsRead) {
  const PseudoTerminal terminal;
  const FakeUnit unit(terminal, [](const link::Frame& request) {
    const std::uint16_t number = request.sequence;
    link::Hello hello{};
    if (link::read(request, hello)) {
      return link::frame_of(link::Greeted{hello.session, 0}, number);
    }
    link::ReadScale scale{};
    if (link::read(request, scale)) {
      return link::frame_of(link::scale_of(scale.quantity, app::full_scales.at(scale.quantity)),
                            number);
    }
    link::ReadTraceState state{};
    if (!link::read(request, state)) {
      link::Stream stream{};
      EXPECT_TRUE(link::read(request, stream)) << "the trace is read";
      return refused_as_unknown(request);
    }
    const auto whole = static_cast<std::uint8_t>(link::TracePhase::whole);
    return link::frame_of(link::TraceState{whole, 0, 1024, 1, 0, 7}, number);
  });
  process::SerialPort port(terminal.device());
  UnitLink link(port);
  Console console(link);
  const auto answer = [&](const std::string& file) {
    return console.carry_out("trace save " + file).at(0);
  };
  EXPECT_EQ(answer("/dev/null/trace.csv"), "/dev/null: is a file, not a folder");
  EXPECT_EQ(answer("/dev"), "/dev: is a folder; allowed: a new file");
  EXPECT_EQ(answer("/dev/nothing/"), "/dev/nothing/: is a folder; allowed: a new file");
  EXPECT_EQ(answer("/dev/null"), "/dev/null: is there already; allowed: a new file");
  EXPECT_EQ(answer("/proc/trace.csv").find("/proc: cannot be written: "), 0U);
  EXPECT_EQ(console.refused(), 5U);
}

/// What a unit answers to a tare that is off and has no range of an offset.
std::string tare_of(store::Origin parameters) {
  const PseudoTerminal terminal;
  const FakeUnit unit(terminal, [=](const link::Frame& request) {
    const std::uint16_t number = request.sequence;
    link::Hello hello{};
    link::ReadScale scale{};
    link::ReadParameter parameter{};
    if (link::read(request, hello)) {
      return link::frame_of(link::Greeted{hello.session, 0}, number);
    }
    if (link::read(request, scale)) {
      return link::frame_of(link::scale_of(scale.quantity, app::full_scales.at(scale.quantity)),
                            number);
    }
    if (link::read(request, parameter)) {
      return link::frame_of(link::ParameterValue{parameter.parameter, 6, 0, 0, 0, 0}, number);
    }
    if (request.kind == link::ReadTelemetry::kind) {
      link::Telemetry told{};
      told.parameters = static_cast<std::uint8_t>(parameters);
      return link::frame_of(told, number);
    }
    EXPECT_EQ(request.kind, link::Stream::kind) << "something is written";
    return refused_as_unknown(request);
  });
  process::SerialPort port(terminal.device());
  UnitLink link(port);
  return Console(link).carry_out("tare").at(0);
}

TEST(TareTest, NeedsAForceSensor) {
  EXPECT_EQ(tare_of(store::Origin::stored), "the unit reads no force");
}

// What is saved would confirm all parameters.
TEST(TareTest, LeavesParametersAloneThatNobodyHasConfirmed) {
  for (const store::Origin origin : {store::Origin::other_design, store::Origin::damaged}) {
    EXPECT_EQ(tare_of(origin), "see params and confirm them first");
  }
}

TEST_F(TraceConsole, AFullDiskIsTold) {
  ask("trace now");
  while (line_of("trace").find("trace of") != 0) {
  }
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit full{1000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &full);
  const std::string answer = line_of("trace save " + file_);
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_NE(answer.find(": File too large"), std::string::npos) << answer;
  EXPECT_FALSE(std::filesystem::exists(file_));
}

std::string failure_at(const std::string& device) {
  try {
    process::SerialPort port(device);
    UnitLink link(port);
  } catch (const process::ProcessError& error) {
    return error.what();
  }
  return "none";
}

TEST(UnitLinkTest, SaysWhatIsNoUnit) {
  EXPECT_EQ(failure_at("/dev/nowhere"), "/dev/nowhere: No such file or directory");
  EXPECT_EQ(failure_at("/dev/null"), "/dev/null: is no serial line");
  const PseudoTerminal silent;
  EXPECT_EQ(failure_at(silent.device()), silent.device() + ": does not answer");
}

TEST(UnitLinkTest, OneHostAtATimeHasADevice) {
  const PseudoTerminal terminal;
  {
    const process::SerialPort port(terminal.device());
    EXPECT_EQ(failure_at(terminal.device()), terminal.device() + ": is used by another program");
  }
  EXPECT_EQ(failure_at(terminal.device()), terminal.device() + ": does not answer");
}

TEST(UnitLinkTest, KnowsAForeignDeviceByWhatItSays) {
  const PseudoTerminal terminal;
  const std::string text = "login: ";
  const Device device([&] {
    EXPECT_GT(write(terminal.number(), text.data(), text.size()), 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  });
  EXPECT_EQ(failure_at(terminal.device()), terminal.device() + ": answers, but not as a unit does");
}

TEST(UnitLinkTest, KnowsAUnitByAnswersToWhatWasAskedBefore) {
  const PseudoTerminal terminal;
  const FakeUnit unit(terminal, [](const link::Frame& request) {
    return link::frame_of(link::Telemetry{}, static_cast<std::uint16_t>(request.sequence - 1));
  });
  EXPECT_EQ(failure_at(terminal.device()),
            terminal.device() + ": is a unit, but its answer comes too late");
}

TEST(UnitLinkTest, KnowsTheAnswerToAnotherHostsHello) {
  const PseudoTerminal terminal;
  const FakeUnit unit(terminal, [](const link::Frame& request) {
    link::Hello hello{};
    EXPECT_TRUE(link::read(request, hello));
    return link::frame_of(link::Greeted{static_cast<std::uint16_t>(hello.session + 1), 0},
                          request.sequence);
  });
  EXPECT_EQ(failure_at(terminal.device()), terminal.device() + ": answers another host");
}

TEST(UnitLinkTest, KnowsAUnitWithoutAHello) {
  const PseudoTerminal terminal;
  const FakeUnit unit(terminal, refused_as_unknown);
  EXPECT_EQ(failure_at(terminal.device()),
            terminal.device() + ": knows no hello: its firmware is not of this program");
}

TEST(UnitLinkTest, AUnitThatTellsNoScalesIsTooOld) {
  const PseudoTerminal terminal;
  const FakeUnit unit(terminal, [](const link::Frame& request) {
    link::Hello hello{};
    return link::read(request, hello)
               ? link::frame_of(link::Greeted{hello.session, 0}, request.sequence)
               : refused_as_unknown(request);
  });
  process::SerialPort port(terminal.device());
  UnitLink link(port);
  try {
    const Console console(link);
    ADD_FAILURE() << "it is taken";
  } catch (const process::ProcessError& error) {
    EXPECT_EQ(error.what(), terminal.device() +
                                ": does not tell its scales: its firmware is older than this "
                                "program; build its image again");
  }
}

TEST(UnitLinkTest, AStopThatWaitsForNoAnswerIsSentThreeTimes) {
  const PseudoTerminal terminal;
  process::SerialPort port(terminal.device());
  std::optional<FakeUnit> unit(std::in_place, terminal, [](const link::Frame& request) {
    link::Hello hello{};
    return link::read(request, hello)
               ? link::frame_of(link::Greeted{hello.session, 0}, request.sequence)
               : refused_as_unknown(request);
  });
  const UnitLink link(port);
  unit.reset();
  link.send_stop();
  const TerminalLink line(terminal);
  link::FrameDecoder decoder;
  int stops = 0;
  for (std::uint8_t byte = 0;
       stops < 3 && process::wait_for_input(terminal.number(), std::chrono::seconds(10));) {
    ASSERT_TRUE(line.receive(byte));
    link::Stop stop{};
    stops +=
        decoder.take(byte) == link::Reception::frame && link::read(decoder.frame(), stop) ? 1 : 0;
  }
  EXPECT_EQ(stops, 3);
}

TEST(UnitLinkTest, KnowsAUnitOfAnotherVersion) {
  const PseudoTerminal terminal;
  // Version 1 of the protocol, kind, sequence number, checksum: as a unit of old would say it.
  const std::vector<std::uint8_t> bytes = [] {
    encoding::Crc32 sum;
    const std::vector<std::uint8_t> content = {1, 0x81, 1, 1};
    for (const std::uint8_t byte : content) {
      sum.add(byte);
    }
    std::vector<std::uint8_t> wire(20);
    encoding::CobsEncoder stuffing(&wire[1]);
    for (const std::uint8_t byte : content) {
      stuffing.add(byte);
    }
    for (int i = 0; i < 4; ++i) {
      stuffing.add(static_cast<std::uint8_t>(sum.value() >> (8 * i)));
    }
    wire.resize(1 + stuffing.finish() + 1);
    return wire;
  }();
  const Device device([&] {
    EXPECT_GT(write(terminal.number(), bytes.data(), bytes.size()), 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  });
  EXPECT_EQ(failure_at(terminal.device()),
            terminal.device() +
                ": speaks another version of the link: its firmware is not of this program");
}

}  // namespace
}  // namespace sonoglide::unit::console_test
