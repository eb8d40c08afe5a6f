// The same controller source on the host and as an image on an emulated board: the same commands.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "firmware/control/interface/drive_command.hpp"
#include "hal/lockstep/frame.hpp"
#include "host_sim/boards/emulated/board_list.hpp"
#include "host_sim/boards/emulated/lockstep_image.hpp"
#include "host_sim/boards/emulated/run_image.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/loop/control/control_port.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/process/child_process.hpp"
#include "host_sim/process/pipe.hpp"
#include "host_sim/process/serial_port.hpp"
#include "tested_boards.hpp"
#include "tests/host_sim/boards/unit/terminal/pseudo_terminal.hpp"
#include "tests/host_sim/loop/logs/logged_run.hpp"

namespace sonoglide::emulated::lockstep_test {
namespace {

using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""s;

constexpr int shut_down = static_cast<int>(hal::lockstep::ExitCode::shut_down);
constexpr int link_broken = static_cast<int>(hal::lockstep::ExitCode::link_broken);
constexpr int processor_fault = static_cast<int>(hal::lockstep::ExitCode::processor_fault);

std::string image(const std::string& board, const std::string& controller) {
  return SONOGLIDE_IMAGES "/" + board + "/bin/" + controller + ".elf";
}

std::vector<std::string> emulate(const std::string& board, const std::string& image) {
  return emulated::emulator_command(*emulated::find_board(board), image);
}

scene::Scene scene_of(const std::string& controller) {
  return experiment::read_file(SONOGLIDE_CONTROLLERS "/" + controller + "/scene.toml").plant;
}

struct BoardImage {
  std::string board;
  std::string controller;
};

/// Of words BOARD/CONTROLLER.
std::vector<BoardImage> images(const std::vector<std::string>& words) {
  std::vector<BoardImage> all;
  for (const std::string& word : words) {
    const std::size_t slash = word.find('/');
    all.push_back({word.substr(0, slash), word.substr(slash + 1)});
  }
  return all;
}

/// An image on a board.
class Image : public testing::TestWithParam<BoardImage> {
 protected:
  Image() : Image(GetParam().board, GetParam().controller) {}
  Image(const std::string& board, const std::string& controller)
      : scene_(scene_of(controller)), board_(emulate(board, image(board, controller)), 60s) {}

  scene::Scene scene_;
  ImageProcess board_;
};

/// Closes the loop of a scene with the controller on a board, and compares every period and command
/// with those of the host's controller.
void expect_the_hosts_commands(const scene::Scene& scene, ImageProcess& board) {
  const loop::LoggedRun host = loop::run_logged(scene);
  const loop::ControlRecord& expected = *host.result.control;
  loop::PeriodLog log;
  loop::Watch watch;
  watch.periods = {&log};
  ImageControl controller(board, hal::lockstep::counts_per_clock);
  const loop::RunResult run = loop::run(scene, expected.design, controller, watch);
  ASSERT_EQ(log.periods.size(), host.periods.size());
  for (std::size_t k = 0; k < log.periods.size(); ++k) {
    const loop::Period& period = log.periods[k];
    ASSERT_EQ(period.drive_amplitude_N, host.periods[k].drive_amplitude_N)
        << "carrier period " << k;
    ASSERT_EQ(period.state, host.periods[k].state) << "carrier period " << k;
    ASSERT_EQ(period.limit, host.periods[k].limit) << "carrier period " << k;
  }
  EXPECT_EQ(run.control->commands, log.periods.size());
  EXPECT_EQ(run.control->trace_hash, expected.trace_hash);
}

TEST_P(Image, DrivesThePlantWithTheHostsCommandsBitForBit) {
  expect_the_hosts_commands(scene_, board_);
  EXPECT_EQ(board_.shut_down(), shut_down);
}

TEST_P(Image, AnswersAnyConverterCodeAsTheHostDoes) {
  const auto host = loop::make_control_port(scene_, configure::design_control(scene_));
  const std::vector<scene::TargetStep>& targets = scene_.controller->targets();
  double changes_s = 2e-3;
  if (!targets.empty()) {  // else a texture, which the host's controller follows by itself
    host->set_target(targets[0].value);
    changes_s = targets[1].time_s;
  }
  std::mt19937 generator(1);
  const auto code = [&] { return static_cast<std::int32_t>(generator()); };
  const auto periods = static_cast<int>(changes_s * scene_.drive->frequency_Hz) - 1;
  for (int k = 0; k < periods; ++k) {
    const std::int32_t force = code();
    const hal::Sample sample{force, code() >> (k % 12), k + 1 == periods, true};
    const hal::Drive expected = host->exchange(sample);
    const hal::Drive drive = board_.exchange(sample);
    ASSERT_EQ(drive.amplitude, expected.amplitude) << "carrier period " << k;
    ASSERT_EQ(drive.state, expected.state) << "carrier period " << k;
    ASSERT_EQ(drive.limit, expected.limit) << "carrier period " << k;
    ASSERT_EQ(drive.fault, expected.fault) << "carrier period " << k;
  }
}

TEST_P(Image, FaultsOnASampleThatDidNotArrive) {
  const hal::Drive drive = board_.exchange(hal::Sample{1, 1, false, false});
  EXPECT_EQ(drive.amplitude, 0);
  EXPECT_EQ(drive.state, static_cast<std::uint8_t>(control::State::fault));
  EXPECT_EQ(drive.fault, static_cast<std::uint8_t>(control::Fault::measurement_missing));
}

TEST_P(Image, LeavesWhenAFrameIsCutShort) {
  const std::uint8_t half[hal::lockstep::sample_frame_size / 2]{};
  board_.send(half, sizeof half);
  EXPECT_EQ(board_.shut_down(), link_broken);
}

TEST_P(Image, LeavesWhenAFrameIsOutOfTurn) {
  const hal::lockstep::SampleFrame frame = hal::lockstep::encode(7, hal::Sample{});
  board_.send(frame.data(), frame.size());
  EXPECT_EQ(board_.shut_down(), link_broken);
}

std::string test_name_of(std::string board) {
  std::replace(board.begin(), board.end(), '-', '_');
  return board;
}
std::string image_name(const testing::TestParamInfo<BoardImage>& tested) {
  return test_name_of(tested.param.board) + "_" + tested.param.controller;
}

INSTANTIATE_TEST_SUITE_P(Boards, Image, testing::ValuesIn(images({SONOGLIDE_DRIVEN_IMAGES})),
                         image_name);

/// A unit that observes the vibration.
class ObservingImage : public Image {};

TEST_P(ObservingImage, AnswersAnyConverterCodeAsTheHostDoes) {
  const auto host = loop::make_control_port(scene_, configure::design_control(scene_));
  host->set_target(scene_.controller->targets()[0].value);
  std::mt19937 generator(1);
  const auto code = [&](int k) { return static_cast<std::int32_t>(generator()) >> (k % 12); };
  constexpr int periods = 100;
  for (int k = 0; k < periods; ++k) {
    const bool last = k + 1 == periods;
    const hal::VibrationSample sample{
        {code(k), code(k), false, true}, code(k / 2), code(k / 2), last, true};
    const hal::ResonantDrive expected = host->exchange(sample);
    const hal::ResonantDrive drive = board_.exchange(sample);
    ASSERT_EQ(drive.amplitude, expected.amplitude) << "carrier period " << k;
    ASSERT_EQ(drive.frequency, expected.frequency) << "carrier period " << k;
    ASSERT_EQ(drive.limit, expected.limit) << "carrier period " << k;
    ASSERT_EQ(drive.fault, expected.fault) << "carrier period " << k;
  }
}

TEST_P(ObservingImage, FaultsOnAVibrationThatDidNotArrive) {
  const hal::ResonantDrive drive =
      board_.exchange(hal::VibrationSample{{1, 1, false, true}, 0, 0, false, false});
  EXPECT_EQ(drive.amplitude, 0);
  EXPECT_EQ(drive.fault, static_cast<std::uint8_t>(control::Fault::vibration_missing));
}

TEST_P(ObservingImage, FaultsOnAVibrationAtTheRail) {
  const hal::ResonantDrive drive =
      board_.exchange(hal::VibrationSample{{1, 1, false, true}, 0, 0, true, true});
  EXPECT_EQ(drive.amplitude, 0);
  EXPECT_EQ(drive.fault, static_cast<std::uint8_t>(control::Fault::vibration_saturated));
}

INSTANTIATE_TEST_SUITE_P(Boards, ObservingImage,
                         testing::ValuesIn(images({SONOGLIDE_OBSERVING_IMAGES})), image_name);

/// A unit that answers with a bias.
class BiasedImage : public Image {
 protected:
  hal::BiasedDrive exchange(const hal::MotionSample& sample) {
    return scene_.sensor.vibration
               ? board_.exchange_biased(sample)
               : board_.exchange_biased(static_cast<const hal::Sample&>(sample));
  }
};

/// Plausible samples first, so that it drives; then any codes.
TEST_P(BiasedImage, AnswersAnyConverterCodeAsTheHostDoes) {
  const auto host = loop::make_control_port(scene_, configure::design_control(scene_));
  host->set_target(scene_.controller->targets()[0].value);
  const auto expected_of = [&](const hal::MotionSample& sample) {
    return scene_.sensor.vibration ? host->exchange_biased(sample)
                                   : host->exchange_biased(static_cast<const hal::Sample&>(sample));
  };
  std::mt19937 generator(1);
  const auto code = [&](int k) { return static_cast<std::int32_t>(generator()) >> (k % 12); };
  constexpr int periods = 110;
  constexpr int plausible = 100;
  int biased = 0;
  for (int k = 0; k < periods; ++k) {
    const bool wild = k >= plausible;
    const std::int32_t force = wild ? code(k) : (1 << 29) + (code(k) >> 6);
    const hal::MotionSample sample{{{force, wild ? code(k) : 1 << 26, false, true},
                                    wild ? code(k) : code(k) >> 8,
                                    wild ? code(k) : -(1 << 28),
                                    false,
                                    true},
                                   code(k) >> 8};
    const hal::BiasedDrive expected = expected_of(sample);
    const hal::BiasedDrive drive = exchange(sample);
    ASSERT_EQ(drive.amplitude, expected.amplitude) << "carrier period " << k;
    ASSERT_EQ(drive.bias, expected.bias) << "carrier period " << k;
    ASSERT_EQ(drive.state, expected.state) << "carrier period " << k;
    ASSERT_EQ(drive.limit, expected.limit) << "carrier period " << k;
    ASSERT_EQ(drive.fault, expected.fault) << "carrier period " << k;
    biased += drive.bias != 0 ? 1 : 0;
  }
  EXPECT_GT(biased, 30);
  EXPECT_EQ(board_.shut_down(), shut_down);
}

TEST_P(BiasedImage, HasNoBiasAfterASampleThatDidNotArrive) {
  const hal::BiasedDrive drive = exchange({{{1, 1, false, false}, 1, 1, false, true}, 1 << 30});
  EXPECT_EQ(drive.bias, 0);
  EXPECT_EQ(drive.fault, static_cast<std::uint8_t>(control::Fault::measurement_missing));
}

INSTANTIATE_TEST_SUITE_P(Boards, BiasedImage, testing::ValuesIn(images({SONOGLIDE_BIASED_IMAGES})),
                         image_name);

/// A board whose image speaks over its serial line.
class SerialImage : public testing::TestWithParam<std::string> {
 protected:
  SerialImage()
      : board_(emulated::serial_emulator_command(*emulated::find_board(GetParam()),
                                                 image(GetParam(), "target_step_serial")),
               60s) {
    board_.await_greeting();
  }

  ImageProcess board_;
};

TEST_P(SerialImage, DrivesThePlantWithTheHostsCommandsBitForBit) {
  expect_the_hosts_commands(scene_of("target_step"), board_);
}

TEST_P(SerialImage, LeavesWhenAFrameIsOutOfTurn) {
  const hal::lockstep::SampleFrame frame = hal::lockstep::encode(7, hal::Sample{});
  board_.send(frame.data(), frame.size());
  EXPECT_EQ(board_.shut_down(), link_broken);
}

/// Over a serial device whose other end is a board.
class BoardAtPort : public testing::TestWithParam<std::string> {};

TEST_P(BoardAtPort, RunsASceneAsPilDoesAtAPort) {
  const configure::Experiment experiment =
      experiment::read_file(SONOGLIDE_CONTROLLERS "/target_step/scene.toml");
  const unit::PseudoTerminal device;
  process::Pipe to_board = process::make_pipe();
  process::Pipe from_board = process::make_pipe();
  process::SerialPort port(device.device());
  const process::ChildProcess emulator(
      emulated::serial_emulator_command(*emulated::find_board(GetParam()),
                                        image(GetParam(), "target_step_serial")),
      {to_board.read_end.number(), from_board.write_end.number(), STDERR_FILENO}, SIGKILL);
  from_board.write_end.close();
  const unit::Relay relay(device, from_board.read_end.number(), to_board.write_end.number());
  const loop::RunResult result = run_board(experiment, port, {});
  EXPECT_TRUE(result.image->workstation->same);
  EXPECT_EQ(result.image->board, device.device());
  EXPECT_FALSE(result.image->memory);
}

TEST(DeafBoard, IsToldAsOneThatOnlyGreets) {
  const unit::PseudoTerminal device;
  process::SerialPort port(device.device());
  const unit::TerminalLink board(device);
  std::atomic<bool> told = false;
  std::thread greetings([&] {
    while (!told && board.send(hal::lockstep::greeting)) {
      std::this_thread::sleep_for(1ms);
    }
  });
  emulated::SerialImage image(port, 100ms);
  image.await_greeting();
  EXPECT_THROW(
      {
        try {
          image.exchange(hal::Sample{});
        } catch (const ImageError& error) {
          EXPECT_NE(std::string(error.what()).find("greets, but for 100 ms has answered no frame"),
                    std::string::npos)
              << error.what();
          throw;
        }
      },
      ImageError);
  told = true;
  greetings.join();
}

INSTANTIATE_TEST_SUITE_P(Boards, SerialImage, testing::ValuesIn(emulated::tested_boards()),
                         [](const auto& parameter) { return test_name_of(parameter.param); });

INSTANTIATE_TEST_SUITE_P(Boards, BoardAtPort, testing::ValuesIn(emulated::tested_boards()),
                         [](const auto& parameter) { return test_name_of(parameter.param); });

TEST(ImageTest, LeavesOnAFaultOfACortexM) {
  // A Cortex-M3 has no floating-point unit to enable.
  ImageProcess board(emulate("mps2-an385", image("mps2-an386", "target_step")), 60s);
  EXPECT_EQ(board.shut_down(), processor_fault);
}

TEST(ImageTest, LeavesOnATrapOfARiscV) {
  std::vector<std::string> command =
      emulate("riscv32-virt", image("riscv32-virt", "target_step_q31"));
  command.insert(command.end(), {"-cpu", "rv32,m=false"});  // cannot multiply
  ImageProcess board(command, 60s);
  // The answer to a sample that is not fresh takes no product.
  const hal::lockstep::SampleFrame frame =
      hal::lockstep::encode(0, hal::Sample{1 << 29, 1 << 26, false, true});
  board.send(frame.data(), frame.size());
  EXPECT_EQ(board.shut_down(), processor_fault);
}

}  // namespace
}  // namespace sonoglide::emulated::lockstep_test
