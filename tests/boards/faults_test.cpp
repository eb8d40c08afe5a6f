// Faults in closed loop: one script of bad samples, on the workstation and in images, bit for bit
// the same; and what a link does to an image.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <limits>
#include <memory>
#include <ostream>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

#include "firmware/control/interface/drive_command.hpp"
#include "firmware/numeric/scalar.hpp"
#include "hal/lockstep/frame.hpp"
#include "host_sim/boards/emulated/board_list.hpp"
#include "host_sim/boards/emulated/lockstep_image.hpp"
#include "host_sim/boards/emulated/run_image.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/loop/control/control_port.hpp"
#include "host_sim/loop/run.hpp"
#include "monitor.hpp"

namespace sonoglide::emulated::faults_test {
namespace {

using std::chrono_literals::operator""s;

constexpr std::int32_t largest = std::numeric_limits<std::int32_t>::max();
constexpr std::uint32_t for_good = std::numeric_limits<std::uint32_t>::max();

/// Bits without a pattern, the same for the same period.
std::int32_t noise(std::uint32_t period) {
  std::uint32_t bits = period * 2654435769U;
  bits = (bits ^ bits >> 15) * 2246822519U;
  return static_cast<std::int32_t>(bits ^ bits >> 13);
}

/// What the controller is shown instead of a sample.
using Alteration = hal::Sample (*)(hal::Sample sample, const hal::Sample& first,
                                   std::uint32_t period);

struct Script {
  const char* name;
  std::uint32_t begin;  ///< the first period whose sample is altered
  std::uint32_t length;
  Alteration alter;
  control::Fault fault;  ///< none: the drive goes on
  control::Limit limit;  ///< that is named while the samples are altered
  std::uint32_t within;  ///< so many answers after the first altered one that is so
};

void PrintTo(const Script& script, std::ostream* stream) {
  *stream << script.name;
}

hal::Sample stuck_force(hal::Sample sample, const hal::Sample& first, std::uint32_t /*period*/) {
  sample.friction_force = first.friction_force;
  return sample;
}
hal::Sample dead_force(hal::Sample sample, const hal::Sample& /*first*/, std::uint32_t /*period*/) {
  sample.friction_force = 0;
  return sample;
}
hal::Sample force_at_rail(hal::Sample sample, const hal::Sample& /*first*/,
                          std::uint32_t /*period*/) {
  sample.friction_force = largest;
  sample.force_at_rail = true;
  return sample;
}
hal::Sample missing(hal::Sample /*sample*/, const hal::Sample& first, std::uint32_t /*period*/) {
  return {first.friction_force, first.sliding_velocity, false, false};
}
hal::Sample noisy_force(hal::Sample sample, const hal::Sample& /*first*/, std::uint32_t period) {
  sample.friction_force = noise(period);
  return sample;
}
hal::Sample noisy_velocity(hal::Sample sample, const hal::Sample& /*first*/, std::uint32_t period) {
  sample.sliding_velocity = noise(period);
  return sample;
}
hal::Sample dead_velocity(hal::Sample sample, const hal::Sample& /*first*/,
                          std::uint32_t /*period*/) {
  sample.sliding_velocity = 0;
  return sample;
}
hal::Sample velocity_at_rail(hal::Sample sample, const hal::Sample& /*first*/,
                             std::uint32_t /*period*/) {
  sample.sliding_velocity = largest;
  sample.velocity_at_rail = true;
  return sample;
}
/// The sliding has turned, and the velocity does not show it.
hal::Sample turned_friction(hal::Sample sample, const hal::Sample& first,
                            std::uint32_t /*period*/) {
  sample.friction_force = -sample.friction_force;
  sample.sliding_velocity = first.sliding_velocity;
  return sample;
}

/// Answers after the last altered one until the drive is again what it would have been.
constexpr std::size_t settles_within = 22;

// A reading that stands still shows when the drive has to move: target steps are in force from the
// samples of periods 119 and 239 on.
constexpr control::Fault no_fault = control::Fault::none;
constexpr control::Limit no_limit = control::Limit::none;
constexpr Script scripts[] = {
    {"force_stuck", 100, for_good, stuck_force, control::Fault::measurement_stuck, no_limit, 39},
    {"force_dead", 60, for_good, dead_force, control::Fault::measurement_stuck, no_limit, 17},
    {"force_at_rail", 60, 1, force_at_rail, control::Fault::measurement_saturated, no_limit, 0},
    {"missing_once", 60, 1, missing, control::Fault::measurement_missing, no_limit, 0},
    {"missing_twice", 150, 2, missing, control::Fault::measurement_missing, no_limit, 0},
    {"missing_at_first", 0, 20, missing, control::Fault::measurement_missing, no_limit, 0},
    {"missing_for_good", 300, for_good, missing, control::Fault::measurement_missing, no_limit, 0},
    {"force_noisy", 40, 10, noisy_force, no_fault, no_limit, 0},
    {"velocity_noisy", 40, 10, noisy_velocity, no_fault, no_limit, 0},
    {"velocity_dead", 40, 10, dead_velocity, no_fault, control::Limit::speed_floor, 3},
    {"velocity_at_rail", 40, 10, velocity_at_rail, no_fault, control::Limit::velocity_at_rail, 0},
    {"velocity_stuck", 60, for_good, turned_friction, control::Fault::velocity_stuck, no_limit, 22},
};

/// A controller behind a sensor that follows a script; keeps what it answers.
class ScriptedControl final : public loop::ControlPort {
 public:
  ScriptedControl(loop::ControlPort& control, const Script& script)
      : control_(control), script_(script) {}

  void set_target(double friction_ratio) override { control_.set_target(friction_ratio); }

  hal::Drive exchange(const hal::Sample& sample) override {
    const auto period = static_cast<std::uint32_t>(drives.size());
    if (period == script_.begin) {
      first_ = sample;
    }
    const bool altered = script_.begin <= period && period - script_.begin < script_.length;
    drives.push_back(control_.exchange(altered ? script_.alter(sample, first_, period) : sample));
    return drives.back();
  }

  std::vector<numeric::SignalRecord> signals() const override { return {}; }

  std::vector<hal::Drive> drives;

 private:
  loop::ControlPort& control_;
  const Script& script_;
  hal::Sample first_{};
};

scene::Scene scene_of(const std::string& controller) {
  scene::Scene scene =
      experiment::read_file(SONOGLIDE_CONTROLLERS "/" + controller + "/scene.toml").plant;
  scene.run.record.clear();
  return scene;
}

std::vector<std::string> emulate(const std::string& board, const std::string& controller) {
  return emulated::emulator_command(*emulated::find_board(board),
                                    SONOGLIDE_IMAGES "/" + board + "/bin/" + controller + ".elf");
}

std::vector<hal::Drive> drives(const scene::Scene& scene, loop::ControlPort& control,
                               const Script& script) {
  ScriptedControl scripted(control, script);
  loop::run(scene, configure::design_control(scene), scripted);
  return scripted.drives;
}

std::vector<hal::Drive> drives_on_host(const scene::Scene& scene, const Script& script) {
  const auto control = loop::make_control_port(scene, configure::design_control(scene));
  return drives(scene, *control, script);
}

std::vector<hal::Drive> drives_in_image(const scene::Scene& scene, const std::string& board,
                                        const std::string& controller, const Script& script) {
  ImageProcess image(emulate(board, controller), 60s);
  ImageControl control(image, hal::lockstep::counts_per_clock);
  return drives(scene, control, script);
}

void expect_gone_for_good(const std::vector<hal::Drive>& drives, std::size_t from,
                          control::Fault fault) {
  ASSERT_LT(from, drives.size());
  for (std::size_t k = from; k < drives.size(); ++k) {
    ASSERT_EQ(drives[k].amplitude, 0) << "period " << k;
    ASSERT_EQ(drives[k].state, static_cast<std::uint8_t>(control::State::fault)) << "period " << k;
    ASSERT_EQ(drives[k].fault, static_cast<std::uint8_t>(fault)) << "period " << k;
  }
}

void expect_limited(const std::vector<hal::Drive>& drives, std::size_t from, std::size_t end,
                    control::Limit limit) {
  ASSERT_LT(from, end);
  ASSERT_LE(end, drives.size());
  for (std::size_t k = from; k < end; ++k) {
    ASSERT_EQ(drives[k].state, static_cast<std::uint8_t>(control::State::limited))
        << "period " << k;
    ASSERT_EQ(drives[k].limit, static_cast<std::uint8_t>(limit)) << "period " << k;
    if (limit == control::Limit::speed_floor) {
      ASSERT_EQ(drives[k].amplitude, drives[from].amplitude) << "period " << k;
    }
  }
}

/// The drive is what it is without any alteration, but for what the actuator's end left in the
/// undamped natural mode: the ringing lowers the friction too, and feedback takes that off.
void expect_settled(const std::vector<hal::Drive>& drives, const std::vector<hal::Drive>& unaltered,
                    std::size_t from) {
  ASSERT_LT(from, drives.size());
  for (std::size_t k = from; k < drives.size(); ++k) {
    ASSERT_EQ(drives[k].fault, 0) << "period " << k;
    ASSERT_NEAR(numeric::from_code<double>(drives[k].amplitude),
                numeric::from_code<double>(unaltered[k].amplitude), 0.025)
        << "period " << k;
  }
}

constexpr const char* on_host = "host";

/// (on the host or which board, controller, script)
class FaultScript : public testing::TestWithParam<std::tuple<std::string, std::string, Script>> {};

TEST_P(FaultScript, EndsAsDocumentedAndOnABoardAsOnTheHost) {
  const auto& [where, controller, script] = GetParam();
  const scene::Scene scene = scene_of(controller);
  const std::vector<hal::Drive> host = drives_on_host(scene, script);
  ASSERT_EQ(host.size(), 360U);
  if (where != on_host) {
    const std::vector<hal::Drive> image = drives_in_image(scene, where, controller, script);
    ASSERT_EQ(image.size(), host.size());
    for (std::size_t k = 0; k < host.size(); ++k) {
      ASSERT_EQ(image[k].amplitude, host[k].amplitude) << "period " << k;
      ASSERT_EQ(image[k].state, host[k].state) << "period " << k;
      ASSERT_EQ(image[k].limit, host[k].limit) << "period " << k;
      ASSERT_EQ(image[k].fault, host[k].fault) << "period " << k;
    }
    return;
  }
  if (script.fault != no_fault) {
    expect_gone_for_good(host, script.begin + script.within, script.fault);
    return;
  }
  const std::size_t end = script.begin + script.length;
  if (script.limit != no_limit) {
    expect_limited(host, script.begin + script.within, end, script.limit);
  }
  Script unaltered = script;
  unaltered.length = 0;
  expect_settled(host, drives_on_host(scene, unaltered), end + settles_within);
}

INSTANTIATE_TEST_SUITE_P(Loops, FaultScript,
                         testing::Combine(testing::Values(on_host, "microbit", "mps2-an386"),
                                          testing::Values("target_step", "target_step_q31"),
                                          testing::ValuesIn(scripts)),
                         [](const auto& parameter) {
                           std::string name = std::get<0>(parameter.param);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name + "_" + std::get<1>(parameter.param) + "_" +
                                  std::get<2>(parameter.param).name;
                         });

/// What may happen to the frames of a link after some good ones.
struct LinkFault {
  const char* name;
  std::vector<std::uint8_t> (*bytes)(
      std::uint32_t period);  ///< sent instead of that period's frame
};

void PrintTo(const LinkFault& fault, std::ostream* stream) {
  *stream << fault.name;
}

std::vector<std::uint8_t> frame_of(std::uint32_t period) {
  const hal::lockstep::SampleFrame frame =
      hal::lockstep::encode(period, hal::Sample{1, 1, false, true});
  return {frame.begin(), frame.end()};
}
std::vector<std::uint8_t> truncated(std::uint32_t period) {
  std::vector<std::uint8_t> frame = frame_of(period);
  frame.pop_back();
  return frame;
}
std::vector<std::uint8_t> corrupted(std::uint32_t period) {
  std::vector<std::uint8_t> frame = frame_of(period);
  frame[3] ^= 0x80;
  return frame;
}
std::vector<std::uint8_t> duplicated(std::uint32_t period) {
  return frame_of(period - 1);
}
std::vector<std::uint8_t> reordered(std::uint32_t period) {
  std::vector<std::uint8_t> frames = frame_of(period + 1);
  const std::vector<std::uint8_t> late = frame_of(period);
  frames.insert(frames.end(), late.begin(), late.end());
  return frames;
}
std::vector<std::uint8_t> shifted(std::uint32_t period) {
  std::vector<std::uint8_t> frame = frame_of(period);
  frame.insert(frame.begin(), 0x55);
  return frame;
}

constexpr LinkFault link_faults[] = {{"truncated", truncated},
                                     {"corrupted", corrupted},
                                     {"duplicated", duplicated},
                                     {"reordered", reordered},
                                     {"shifted", shifted}};

constexpr int link_broken = static_cast<int>(hal::lockstep::ExitCode::link_broken);
constexpr std::uint32_t good_periods = 50;

hal::Sample good_sample(std::uint32_t period) {
  return {noise(period) / 4, largest / 10, false, true};
}

/// (board, fault)
class BrokenLink : public testing::TestWithParam<std::tuple<std::string, LinkFault>> {};

TEST_P(BrokenLink, EndsTheImageWithoutAnotherCommand) {
  const auto& [board, fault] = GetParam();
  ImageProcess image(emulate(board, "target_step"), 60s);
  for (std::uint32_t period = 0; period < good_periods; ++period) {
    image.exchange(good_sample(period));
  }
  const std::vector<std::uint8_t> bytes = fault.bytes(good_periods);
  image.send(bytes.data(), bytes.size());
  EXPECT_EQ(image.shut_down(), link_broken);
}

INSTANTIATE_TEST_SUITE_P(Boards, BrokenLink,
                         testing::Combine(testing::Values("microbit", "mps2-an386"),
                                          testing::ValuesIn(link_faults)),
                         [](const auto& parameter) {
                           std::string name = std::get<0>(parameter.param);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name + "_" + std::get<1>(parameter.param).name;
                         });

class ResetInMidRun : public testing::TestWithParam<std::string> {};

// After a reset the image expects period 0. The frame that it was reading is gone, so that the host
// waits for an answer until it asks again.
TEST_P(ResetInMidRun, EndsTheImage) {
  Monitor monitor;
  std::vector<std::string> command = emulate(GetParam(), "target_step");
  const std::vector<std::string> more = monitor.arguments();
  command.insert(command.end(), more.begin(), more.end());
  std::atomic<std::uint32_t> period = 0;
  std::atomic<bool> over = false;
  ImageProcess image(command, 60s);
  for (; period < good_periods; ++period) {
    image.exchange(good_sample(period));
  }
  monitor.request_reset();
  std::thread asking_again([&] {
    for (; !over; std::this_thread::sleep_for(std::chrono::milliseconds(100))) {
      const std::vector<std::uint8_t> frame = frame_of(period);
      image.send(frame.data(), frame.size());
    }
  });
  try {
    for (;; ++period) {
      image.exchange(good_sample(period));
    }
  } catch (const ImageError& error) {
    EXPECT_NE(std::string(error.what()).find("ended with exit code 1"), std::string::npos)
        << error.what();
  }
  over = true;
  asking_again.join();
}

INSTANTIATE_TEST_SUITE_P(Boards, ResetInMidRun, testing::Values("microbit", "mps2-an386"),
                         [](const auto& parameter) {
                           std::string name = parameter.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace sonoglide::emulated::faults_test
