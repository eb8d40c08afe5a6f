// Units on their board's own timer, talked to by the host program over a serial
// device. The emulator's time is that of its
// instructions, so that whether a step is done in time does not depend on the machine.
#include <elf.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "firmware/numeric/scalar.hpp"
#include "host_sim/boards/emulated/board_list.hpp"
#include "host_sim/boards/unit/console.hpp"
#include "host_sim/boards/unit/unit_link.hpp"
#include "host_sim/process/child_process.hpp"
#include "host_sim/process/pipe.hpp"
#include "host_sim/process/scratch_folder.hpp"
#include "host_sim/process/serial_port.hpp"
#include "monitor.hpp"
#include "tested_boards.hpp"
#include "tests/host_sim/boards/unit/terminal/pseudo_terminal.hpp"

namespace sonoglide::emulated::timed_unit_test {
namespace {

using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""s;

struct TimedBoard {
  const char* name;
  int speed;                       ///< an instruction takes 2^speed ns: a step is done in time
  int slow_speed;                  ///< a step is not
  const char* parameters;          ///< what is found in the store after the first reset
  const char* saved_parameters;    ///< and when one has been saved; null: none can be
  std::uint32_t ram = 0x20000000;  ///< where it begins, by the linker script
};

void PrintTo(const TimedBoard& board, std::ostream* stream) {
  *stream << board.name;
}

// The emulator's micro:bit starts with zeros in its flash, which are no erased pages; the flash of
// its Netduino cannot be written.
const std::vector<TimedBoard> timed_boards = {
    {"microbit", 6, 9, "damaged", "stored"},
    {"mps2-an385", 5, 9, "blank", "blank"},
    {"mps2-an386", 5, 10, "blank", "blank"},
    {"mps2-an500", 5, 10, "blank", "blank"},
    {"mps2-an505", 5, 10, "blank", "blank", 0x38000000},
    {"netduinoplus2", 3, 7, "damaged", nullptr},
    {"riscv32-virt", 5, 9, "blank", "blank", 0x80400000},
};

std::string file_of(const std::string& board, const std::string& image) {
  return SONOGLIDE_IMAGES "/" + board + "/bin/" + image + ".elf";
}

std::vector<std::string> emulate_file(const std::string& board, const std::string& file,
                                      int speed) {
  std::vector<std::string> command =
      emulated::serial_emulator_command(*emulated::find_board(board), file);
  command.insert(command.end(), {"-icount", "shift=" + std::to_string(speed)});
  return command;
}

std::vector<std::string> emulate(const std::string& board, const std::string& image, int speed) {
  return emulate_file(board, file_of(board, image), speed);
}

/// What an answer says after a word: of "drive" in "..., drive 480 N, ...", "480 N".
std::string said(const std::string& answer, const std::string& word) {
  const std::size_t at = answer.find(word + " ");
  if (at == std::string::npos) {
    return "nothing of " + word + " in: " + answer;
  }
  const std::size_t begin = at + word.size() + 1;
  return answer.substr(begin, answer.find(',', begin) - begin);
}

/// A person at the host program, and the unit at the other end of a serial device. What goes wrong is
/// thrown.
class Terminal {
 public:
  using Lines = std::vector<std::string>;

  explicit Terminal(std::vector<std::string> command)
      : to_board_(process::make_pipe()),
        from_board_(process::make_pipe()),
        port_(device_.device()),
        emulator_(with_monitor(std::move(command)),
                  {to_board_.read_end.number(), from_board_.write_end.number(), STDERR_FILENO},
                  SIGKILL),
        relay_(device_, from_board_.read_end.number(), to_board_.write_end.number()) {
    from_board_.write_end.close();
  }

  /// Until the unit answers.
  void connect() {
    wait_for([this] {
      try {
        link_.emplace(port_);
        link_.emplace(port_, 20s);
      } catch (const process::ProcessError&) {
        return false;
      }
      return true;
    });
    console_.emplace(*link_);
  }

  /// @return the answer
  Lines lines(const std::string& line) { return console_->carry_out(line); }

  /// @return the first line of the answer
  std::string type(const std::string& line) { return lines(line).at(0); }

  /// A line of an image that has no link.
  std::string next_line() {
    std::string line;
    for (std::uint8_t byte = 0; byte != '\n';) {
      wait_for([&] { return port_.receive(&byte, 1, 100ms) > 0; });
      if (' ' <= byte) {
        line += static_cast<char>(byte);
      }
    }
    return line;
  }

  /// Is silent for a while, and asks for the status, until it has this.
  std::string await(const std::string& words) {
    std::string status;
    wait_for([&] {
      std::this_thread::sleep_for(20ms);
      status = type("status");
      return status.find(words) != std::string::npos;
    });
    return status;
  }

  /// Is silent for a while, and asks for the status, until the unit has come so far.
  void await_period(unsigned long period) {
    wait_for([&] {
      std::this_thread::sleep_for(20ms);
      return period <= std::stoul(said(type("status"), "period"));
    });
  }

  std::uint32_t word(std::uint32_t address) { return monitor_.word(address); }

  /// Of a board without a link; it comes soon.
  void request_reset() { monitor_.request_reset(); }

  /// The target is until reset.
  void reset() {
    type("target 0.123");
    monitor_.request_reset();
    wait_for([&] {
      connect();  // what is asked in the moment of the reset is lost, and waited for
      return type("status").find("target 0.123,") == std::string::npos;
    });
  }

  /// Waits for the emulator to end by itself.
  /// @return its status as of waitpid
  int await_end() {
    wait_for([this] { return relay_.ended(); });
    return emulator_.wait();
  }

 private:
  template <class Condition>
  void wait_for(const Condition& condition) const {
    // A busy machine may keep an emulator waiting for minutes.
    const auto end = std::chrono::steady_clock::now() + 600s;
    while (!condition()) {
      if (relay_.ended() && !condition()) {
        throw std::runtime_error("the emulator has ended");
      }
      if (end < std::chrono::steady_clock::now()) {
        throw std::runtime_error("the emulator hangs");
      }
    }
  }

  std::vector<std::string> with_monitor(std::vector<std::string> command) const {
    const std::vector<std::string> more = monitor_.arguments();
    command.insert(command.end(), more.begin(), more.end());
    return command;
  }

  Monitor monitor_;
  process::Pipe to_board_;
  process::Pipe from_board_;
  unit::PseudoTerminal device_;
  process::SerialPort port_;
  process::ChildProcess emulator_;
  unit::Relay relay_;
  std::optional<unit::UnitLink> link_;
  std::optional<unit::Console> console_;
};

/// @param periods  in which it settles: with the gain as designed it takes fifty at most
void expect_settled(Terminal& terminal, double target, unsigned long periods = 200) {
  std::string status = terminal.type("status");
  const unsigned long begin = std::stoul(said(status, "period"));
  while (std::stoul(said(status, "period")) - begin < periods) {
    status = terminal.type("status");
  }
  EXPECT_EQ(said(status, "fault"), "none") << status;
  EXPECT_NE(status.find(", settled,"), std::string::npos) << status;
  // The contact that stands in has the ratio v / a, with v a tenth of full drive.
  constexpr double full_drive_N = 1920.0;
  EXPECT_NEAR(std::stod(said(status, "drive")) / full_drive_N, 0.1 / target, 1e-3) << status;
}

class TimedUnit : public testing::TestWithParam<TimedBoard> {
 protected:
  static std::vector<std::string> at_speed(int speed) {
    return emulate(GetParam().name, "target_step_timed", speed);
  }

  /// The store is damaged from the factory, and the unit waits for somebody to vouch for it.
  static bool is_held_off() { return GetParam().parameters == std::string("damaged"); }
  static bool saves() { return GetParam().saved_parameters != nullptr; }

  static void start(Terminal& terminal) {
    terminal.connect();
    start_told(terminal);
  }

  static void start_told(Terminal& terminal) {
    if (is_held_off()) {
      terminal.type("confirm");
    }
    const std::string status = terminal.type("restart");
    EXPECT_EQ(status.find("state "), 0U) << status;
  }
};

TEST_P(TimedUnit, IsOffFromPowerOnAndSaysWhy) {
  Terminal terminal(at_speed(GetParam().speed));
  terminal.connect();
  for (int i = 0; i < 2; ++i) {
    const std::string status = terminal.type("status");
    EXPECT_EQ(said(status, "drive"), "0 N") << status;
    EXPECT_EQ(said(status, "state"), is_held_off() ? "fault" : "off") << status;
    EXPECT_EQ(said(status, "fault"), is_held_off() ? "parameters_lost" : "none") << status;
    EXPECT_EQ(said(status, "parameters"), GetParam().parameters) << status;
  }
  if (is_held_off()) {
    EXPECT_EQ(terminal.type("restart"), "see params, then confirm them or set one");
    EXPECT_EQ(terminal.type("confirm"), saves() ? "parameters confirmed, saved"
                                                : "parameters confirmed until reset; not saved");
  }
  terminal.type("restart");
  expect_settled(terminal, 0.4);
}

TEST_P(TimedUnit, HoldsTheTargetThatIsTyped) {
  Terminal terminal(at_speed(GetParam().speed));
  start(terminal);
  expect_settled(terminal, 0.4);
  const std::string status = terminal.type("target 0.7");
  EXPECT_EQ(said(status, "target"), "0.7");
  expect_settled(terminal, 0.7);
  EXPECT_EQ(terminal.type("log"),
            is_held_off() ? "period 0: parameters_lost" : "faults since reset: 0");
}

TEST_P(TimedUnit, RefusesWhatIsOutOfRangeAndRunsOn) {
  Terminal terminal(at_speed(GetParam().speed));
  start(terminal);
  EXPECT_EQ(terminal.type("target 1.5"), "target: allowed is 0 to 1");
  EXPECT_EQ(terminal.type("target -0.1"), "target: allowed is 0 to 1");
  EXPECT_EQ(terminal.type("set gain_scale 2"), "gain_scale: allowed is 0 to 1");
  EXPECT_EQ(terminal.type("set gain_scale 0.5"), "stop the drive first");
  EXPECT_EQ(terminal.type("set gain 0.5"),
            "unknown parameter; there are: target, drive_limit, gain_scale, friction_force, "
            "speed_floor, stuck_periods, start_on_power, host_timeout, bad_samples, force_offset, "
            "force_gain");
  const std::vector<std::string> lines = terminal.lines("params");
  ASSERT_EQ(lines.size(), 11U);
  EXPECT_EQ(lines[0], "target 0.4, compiled in 0.4; allowed is 0 to 1");
  EXPECT_EQ(lines[2], "gain_scale 1, compiled in 1; allowed is 0 to 1");
  expect_settled(terminal, 0.4);
}

TEST_P(TimedUnit, StopsAndRestartsOnRequestAlone) {
  Terminal terminal(at_speed(GetParam().speed));
  start(terminal);
  const std::string stopped = terminal.type("stop");
  EXPECT_EQ(said(stopped, "state"), "off");
  EXPECT_EQ(said(stopped, "drive"), "0 N");
  EXPECT_EQ(said(terminal.type("status"), "state"), "off");
  terminal.type("restart");
  expect_settled(terminal, 0.4);
}

TEST_P(TimedUnit, KeepsSavedParametersAsFarAsItsBoardCan) {
  Terminal terminal(at_speed(GetParam().speed));
  terminal.connect();
  const std::string not_saved =
      "not saved: the flash of the unit took nothing; the old value stands";
  EXPECT_EQ(terminal.type("set gain_scale 0.5"), saves() ? "gain_scale 0.5, saved" : not_saved);
  EXPECT_EQ(terminal.type("set start_on_power 1"), saves() ? "start_on_power 1, saved" : not_saved);
  terminal.reset();
  const std::string origin = saves() ? GetParam().saved_parameters : GetParam().parameters;
  EXPECT_EQ(said(terminal.type("status"), "parameters"), origin);
  EXPECT_EQ(said(terminal.lines("params")[2], "gain_scale"), origin == "stored" ? "0.5" : "1");
  if (origin == "stored") {
    expect_settled(terminal, 0.4, 1000);  // at half the gain, from power-on
  } else {
    EXPECT_EQ(said(terminal.type("status"), "drive"), "0 N");
  }
}

TEST_P(TimedUnit, LosesItsDriveToASilentHostAsFarAsItsBoardSavesATimeout) {
  Terminal terminal(at_speed(GetParam().speed));
  terminal.connect();
  terminal.type("set host_timeout 0.001");
  start_told(terminal);
  if (saves()) {
    const std::string status = terminal.await("drive 0 N,");
    EXPECT_EQ(said(status, "state"), "fault") << status;
    EXPECT_EQ(said(status, "fault"), "host_silent") << status;
  } else {
    EXPECT_EQ(said(terminal.type("status"), "fault"), "none");
  }
}

TEST_P(TimedUnit, AnOverrunTakesTheDriveAwayUntilARestart) {
  Terminal terminal(at_speed(GetParam().slow_speed));
  start(terminal);
  for (std::uint32_t faults = 1; faults < 4; ++faults) {
    const std::string status = terminal.type("status");
    EXPECT_EQ(said(status, "state"), "fault") << status;
    EXPECT_EQ(said(status, "drive"), "0 N") << status;
    EXPECT_EQ(said(status, "fault"), "overrun") << status;
    const std::vector<std::string> log = terminal.lines("log");
    const std::uint32_t before = is_held_off() ? 1 : 0;
    ASSERT_EQ(log.size(), faults + before + 1);
    for (std::uint32_t listed = 0; listed < faults; ++listed) {
      EXPECT_NE(log[listed].find(": overrun"), std::string::npos) << log[listed];
    }
    if (is_held_off()) {
      EXPECT_EQ(log[faults], "period 0: parameters_lost");
    }
    EXPECT_EQ(log.back(), "faults since reset: " + std::to_string(faults + before));
    terminal.type("restart");
  }
}

/// The bytes of an .elf file, and where in it those begin and end that are loaded into flash.
struct LoadedFile {
  std::string bytes;
  std::size_t begin;
  std::size_t end;
};

LoadedFile loaded_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  LoadedFile result{{std::istreambuf_iterator<char>(file), {}}, SIZE_MAX, 0};
  Elf32_Ehdr header{};
  std::memcpy(&header, result.bytes.data(), sizeof header);
  for (std::size_t i = 0; i < header.e_phnum; ++i) {
    Elf32_Phdr segment{};
    std::memcpy(&segment, &result.bytes.at(header.e_phoff + i * header.e_phentsize),
                sizeof segment);
    if (segment.p_type == PT_LOAD && segment.p_filesz > 0) {
      result.begin = std::min<std::size_t>(result.begin, segment.p_offset);
      result.end = std::max<std::size_t>(result.end, segment.p_offset + segment.p_filesz);
    }
  }
  return result;
}

TEST_P(TimedUnit, ABitThatHasFlippedInItsImageHoldsItOff) {
  const LoadedFile whole = loaded_file(file_of(GetParam().name, "target_step_timed"));
  constexpr std::size_t checksum_bytes = 8;
  // None of them changes what runs before the test: the checksum, what is in front of it, a vector that nothing takes.
  std::vector<std::size_t> places{whole.end - 1, whole.end - checksum_bytes - 1};
  if (GetParam().name != std::string("riscv32-virt")) {
    places.push_back(whole.begin + 7 * sizeof(std::uint32_t));
  }
  for (const std::size_t place : places) {
    const process::ScratchFolder folder(testing::TempDir());
    const std::string path = folder.path() / "unit.elf";
    std::string bytes = whole.bytes;
    bytes.at(place) = static_cast<char>(bytes[place] ^ 1);
    std::ofstream(path, std::ios::binary) << bytes;
    Terminal terminal(emulate_file(GetParam().name, path, GetParam().speed));
    terminal.connect();
    const std::string status = terminal.type("status");
    EXPECT_EQ(said(status, "state"), "fault") << place;
    EXPECT_EQ(said(status, "fault"), "image_damaged") << place;
    EXPECT_EQ(terminal.type("log"), "period 0: image_damaged");
    terminal.type("confirm");
    for (const char* const order : {"restart", "stop", "restart"}) {
      const std::string answer = terminal.type(order);
      EXPECT_TRUE(order == std::string("stop") ||
                  answer == "the image in the unit's flash is damaged: load it again")
          << place << ": " << answer;
      EXPECT_EQ(said(terminal.type("status"), "drive"), "0 N") << place;
    }
  }
}

/// As RISC-V, Armv6-M and Armv7-M tell of an instruction that there is not.
void expect_undefined_instruction(const std::string& board, std::uint32_t exception,
                                  std::uint32_t fault_status) {
  if (board == "riscv32-virt") {
    EXPECT_EQ(exception, 2U);
  } else {
    EXPECT_EQ(exception, 3U);
    EXPECT_EQ(fault_status, board == "microbit" ? 0 : 1U << 16);
  }
}

/// What an image says first: while it drives, or of an exception that was kept.
std::vector<std::uint32_t> numbers_of(const std::string& line) {
  std::istringstream text(line);
  return {std::istream_iterator<std::uint32_t>(text), {}};
}

TEST_P(TimedUnit, AnExceptionTakesTheDriveAwayAndIsKeptOverTheReset) {
  Terminal terminal(emulate(GetParam().name, "target_step_exception", GetParam().speed));
  constexpr std::size_t of_driving = 3;
  std::vector<std::uint32_t> said = numbers_of(terminal.next_line());
  std::uint32_t trap = 0;
  // The drive is off before the exception is kept: a reset between them, which a loaded machine brings about, keeps
  // nothing, and the unit drives and traps again.
  for (int i = 0; i < 10 && said.size() == of_driving; ++i) {
    const std::uint32_t address_of_amplitude = said[0];
    EXPECT_NEAR(numeric::from_code<double>(static_cast<std::int32_t>(said[1])), 0.1 / 0.4, 1e-3);
    trap = said[2];
    while (terminal.word(address_of_amplitude) !=
           0) {  // some instructions after the last character
    }
    terminal.request_reset();
    said = numbers_of(terminal.next_line());
  }
  ASSERT_EQ(said.size(), 5U);
  const std::uint32_t exception = said[0];
  const std::uint32_t program_counter = said[1];
  const std::uint32_t program_status = said[2];
  const std::uint32_t fault_status = said[3];
  const std::uint32_t taken_again = said[4];
  EXPECT_EQ(program_counter, trap);
  EXPECT_NE(program_status, 0U);
  EXPECT_EQ(taken_again, 0U);
  expect_undefined_instruction(GetParam().name, exception, fault_status);
}

TEST_P(TimedUnit, WhatItsImageDoesFirstComesBeforeStaticObjectsHaveTheirValues) {
  Terminal terminal(emulate(GetParam().name, "target_step_begun", GetParam().speed));
  struct Line {
    std::uint32_t resets, found_filled, found_cleared, filled, cleared;
  };
  const auto next = [&terminal] {
    std::istringstream words(terminal.next_line());
    Line line{};
    words >> line.resets >> line.found_filled >> line.found_cleared >> line.filled >> line.cleared;
    return line;
  };
  const Line first = next();
  terminal.request_reset();
  const Line second = next();
  EXPECT_EQ(second.resets, first.resets + 1);
  EXPECT_EQ(second.found_filled, 2002U);
  EXPECT_EQ(second.found_cleared, 3003U);
  for (const Line& line : {first, second}) {
    EXPECT_EQ(line.filled, 1001U);
    EXPECT_EQ(line.cleared, 0U);
  }
}

/// From each reset on, what an exception before it would have left in section .noinit.
std::vector<std::string> with_kept_exception(std::vector<std::string> command,
                                             std::uint32_t address) {
  std::uint32_t check = 0x811c9dc5;  // FNV-1a
  const auto load = [&](std::uint32_t word) {
    command.insert(command.end(), {"-device", "loader,addr=" + std::to_string(address) +
                                                  ",data=" + std::to_string(word) + ",data-len=4"});
    address += 4;
  };
  for (const std::uint32_t word :
       {3U, 0x1234U, 0x5679U, 0x61000003U, 0x10000U, 0x40000000U, 0x40000001U}) {
    check = (check ^ word) * 0x01000193;
    load(word);
  }
  load(check);
  return command;
}

TEST_P(TimedUnit, TellsItsHostOfAnExceptionBeforeTheReset) {
  Terminal terminal(with_kept_exception(at_speed(GetParam().speed), GetParam().ram));
  terminal.connect();
  EXPECT_EQ(terminal.lines("log").back(),
            "exception 3 before the reset: program counter 0x00001234, link register 0x00005679, "
            "program status 0x61000003, fault status 0x00010000, hard fault status 0x40000000, "
            "fault address 0x40000001");
}

/// Of the board whose flash the emulator has.
class TimedHistory : public testing::TestWithParam<const char*> {};

TEST_P(TimedHistory, IsKeptOverResets) {
  Terminal terminal(emulate(GetParam(), "target_step_timed", 6));
  terminal.connect();
  EXPECT_EQ(terminal.type("history").find("boot 1, after power-on; in operation 0 h 0 min "), 0U);
  for (int boot = 2; boot < 5; ++boot) {
    terminal.reset();
    const std::string told = terminal.type("history");
    EXPECT_EQ(told.find(fmt::format("boot {}, after a reset; in operation ", boot)), 0U) << told;
    // The flash of the emulator has zeros, which are no history.
    EXPECT_NE(told.find("; boots after the watchdog 0, after an exception 0; began anew: the "
                        "history before it could not be read"),
              std::string::npos)
        << told;
  }
}

std::string name_of(const TimedBoard& board) {
  return board.name;
}
std::string name_of(const char* board) {
  return board;
}

constexpr auto named_after_its_board = [](const auto& parameter) {
  std::string name = name_of(parameter.param);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
};

/// Of boards, or their names, those whose images there are.
template <class Board>
std::vector<Board> tested(std::vector<Board> all) {
  all.erase(std::remove_if(all.begin(), all.end(),
                           [](const Board& each) { return !is_tested(name_of(each)); }),
            all.end());
  return all;
}

INSTANTIATE_TEST_SUITE_P(Boards, TimedUnit, testing::ValuesIn(tested(timed_boards)),
                         named_after_its_board);

INSTANTIATE_TEST_SUITE_P(Boards, TimedHistory, testing::ValuesIn(tested<const char*>({"microbit"})),
                         named_after_its_board);

/// The emulator is to end instead of resetting its board.
std::vector<std::string> ended_by_watchdog(std::vector<std::string> command) {
  command.insert(command.end(), {"-action", "watchdog=poweroff"});
  return command;
}

/// Each of the two watchdogs that are emulated.
class TimedUnitWatchdog : public testing::TestWithParam<const char*> {};

TEST_P(TimedUnitWatchdog, IsFedByAUnitInTime) {
  Terminal terminal(ended_by_watchdog(emulate(GetParam(), "target_step_timed", 5)));
  terminal.connect();
  terminal.type("restart");
  for (int i = 0; i < 3; ++i) {
    const unsigned long begin = std::stoul(said(terminal.type("status"), "period"));
    terminal.await_period(begin + 6'000);  // 0.1 s of the board's time
    expect_settled(terminal, 0.4);
  }
}

TEST_P(TimedUnitWatchdog, ResetsABoardWhoseLoopStandsStill) {
  Terminal terminal(ended_by_watchdog(emulate(GetParam(), "slow_carrier_timed", 10)));
  EXPECT_EQ(terminal.await_end(), 0);
}

TEST_P(TimedUnitWatchdog, ResetsABoardWhoseServiceHangsAfterItsDriveIsAtZero) {
  Terminal terminal(ended_by_watchdog(emulate(GetParam(), "target_step_hung", 5)));
  const std::string driving = terminal.next_line();
  EXPECT_EQ(driving.rfind("hangs, drive ", 0), 0U) << driving;
  EXPECT_GT(std::stoul(said(driving, "drive")), 100'000'000U);
  EXPECT_EQ(terminal.next_line(), "stalled, drive 0");
  EXPECT_EQ(terminal.await_end(), 0);
}

INSTANTIATE_TEST_SUITE_P(Boards, TimedUnitWatchdog,
                         testing::ValuesIn(tested<const char*>({"mps2-an386", "mps2-an505"})),
                         named_after_its_board);

/// On a Cortex-M.
class OwnInterrupts : public testing::TestWithParam<TimedBoard> {};

TEST_P(OwnInterrupts, ComeInTheOrderOfTheirPrioritiesAndOneWithoutAHandlerIsKept) {
  Terminal terminal(emulate(GetParam().name, "target_step_vectored", GetParam().speed));
  const std::string came = terminal.next_line();
  EXPECT_EQ(came, GetParam().name == std::string("microbit") ? "123" : "123452");
  std::string kept = came;
  for (int i = 0; i < 100 && kept == came; ++i) {
    std::this_thread::sleep_for(20ms);  // the reset may come before the interrupt even so
    terminal.request_reset();
    kept = terminal.next_line();
  }
  EXPECT_EQ(kept, std::to_string(16 + 7));
}

std::vector<TimedBoard> cortex_m(std::vector<TimedBoard> all) {
  all.erase(std::remove_if(all.begin(), all.end(),
                           [](const TimedBoard& each) { return name_of(each) == "riscv32-virt"; }),
            all.end());
  return all;
}

INSTANTIATE_TEST_SUITE_P(Boards, OwnInterrupts, testing::ValuesIn(cortex_m(tested(timed_boards))),
                         named_after_its_board);

/// The controller of a scene with controller.every_periods = 16, on the board's timer at the period of its
/// steps; on the smallest processor at eight times as much.
class ReplayedRun : public testing::TestWithParam<TimedBoard> {};

TEST_P(ReplayedRun, HasTheCommandsOfTheWorkstation) {
  Terminal terminal(emulate(GetParam().name, "every_16_replayed", GetParam().speed));
  EXPECT_EQ(terminal.next_line(), "the same commands");
}

INSTANTIATE_TEST_SUITE_P(Boards, ReplayedRun, testing::ValuesIn(tested(timed_boards)),
                         named_after_its_board);

/// The same of units that observe the vibration, off resonance and at it; slower than their scenes.
class ReplayedVibration : public testing::TestWithParam<const char*> {};

TEST_P(ReplayedVibration, HasTheCommandsOfTheWorkstation) {
  for (const char* const image : {"damped_step_replayed", "wire_bonder_q31_replayed"}) {
    Terminal terminal(emulate(GetParam(), image, 5));
    EXPECT_EQ(terminal.next_line(), "the same commands") << image;
  }
}

INSTANTIATE_TEST_SUITE_P(Boards, ReplayedVibration,
                         testing::ValuesIn(tested<const char*>({"microbit", "mps2-an386"})),
                         named_after_its_board);

/// Control in the interrupt of the system timer, at 20 periods from random orders of three seeds each, on
/// the smallest processor, one without and one with a floating-point unit.
/// An order, a restart, a fault: no period takes much longer than others.
class InterruptedUnit : public testing::TestWithParam<const char*> {};

TEST_P(InterruptedUnit, DoesAsTheReplayOfItsOrdersDoes) {
  const int speed =
      GetParam() == std::string("microbit") ? 6 : 5;  // an instruction is about a clock
  for (const char* image : {"target_step_q31_interrupted", "target_step_interrupted"}) {
    // In software the time of a floating-point operation hangs on its operands.
    const bool soft_float =
        GetParam() == std::string("mps2-an385") && image == std::string("target_step_interrupted");
    const double longest_over_median = soft_float ? 1.2 : 1.15;
    Terminal terminal(emulate(GetParam(), image, speed));
    unsigned orders = 0;
    for (int run = 0; run < 60; ++run) {
      std::istringstream line(terminal.next_line());
      std::uint32_t reload = 0;
      std::uint32_t events = 0;
      std::uint32_t hash = 0;
      std::uint32_t replayed = 0;
      std::uint32_t median = 0;
      std::uint32_t longest = 0;
      int whole = 0;
      line >> reload >> events >> hash >> replayed >> median >> longest >> whole;
      EXPECT_EQ(hash, replayed) << line.str();
      EXPECT_EQ(whole, 1) << line.str();
      EXPECT_LE(longest, longest_over_median * median) << line.str();
      orders += events;
    }
    EXPECT_GT(orders, 600U) << image;
  }
}

INSTANTIATE_TEST_SUITE_P(Boards, InterruptedUnit,
                         testing::ValuesIn(tested<const char*>({"microbit", "mps2-an385",
                                                                "mps2-an386"})),
                         named_after_its_board);

}  // namespace
}  // namespace sonoglide::emulated::timed_unit_test
