/// The controller of a scene as an image on an emulated board, where a simulation meets it.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <vector>

#include "host_sim/emulated/board_list.hpp"
#include "host_sim/emulated/image_process.hpp"
#include "host_sim/loop/control_port.hpp"
#include "host_sim/loop/run_result.hpp"
#include "host_sim/process/child_process.hpp"

namespace sonoglide::emulated {

/// What a stretch of an image takes, period by period.
class InstructionCount {
 public:
  void add(std::uint32_t instructions);
  /// @param periods  that were added
  loop::InstructionRange over(std::uint64_t periods) const;

 private:
  std::uint32_t least_ = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t most_ = 0;
  std::uint64_t sum_ = 0;
};

class ImageControl final : public loop::ControlPort {
 public:
  /// @param board      outlives this
  /// @param image      built for it, in lockstep over semihosting
  /// @throws process::ProcessError  the emulator cannot be started
  ImageControl(const emulated::EmulatedBoard& board, const std::filesystem::path& image);

  /// Nothing to do: the image has its targets compiled in, by carrier period.
  void set_target(double friction_ratio) override;

  /// @throws EmulatorError
  hal::Drive exchange(const hal::Sample& sample) override;
  /// @throws EmulatorError
  hal::ResonantDrive exchange(const hal::VibrationSample& sample) override;

  /// None: an image does not watch its signals.
  std::vector<numeric::SignalRecord> signals() const override;

  /// Ends the image.
  /// @return what the run showed of it: how many exchanges a second, the plant's time included and
  ///         that of starting up not, and the cost of its steps
  /// @throws EmulatorError  it does not leave as it should
  loop::ImageRecord shut_down();

 private:
  using Clock = std::chrono::steady_clock;

  template <class Sample>
  auto ask(const Sample& sample);

  const emulated::EmulatedBoard& board_;
  process::OneCore core_;
  ImageProcess image_;
  Clock::time_point first_answer_;
  std::uint64_t exchanges_ = 0;
  InstructionCount step_;
  InstructionCount answer_;
};

}  // namespace sonoglide::emulated
