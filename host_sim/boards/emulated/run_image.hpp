/// A closed loop with the real image of its controller.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "host_sim/boards/emulated/board_list.hpp"
#include "host_sim/boards/emulated/lockstep_image.hpp"
#include "host_sim/configure/experiment.hpp"
#include "host_sim/loop/control/control_port.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/loop/run_result.hpp"
#include "host_sim/process/serial_port.hpp"

namespace sonoglide::emulated {

// The controller of a scene as an image on an emulated board, where a simulation meets it.

/// What a stretch of an image takes, period by period.
class InstructionCount {
 public:
  void add(std::uint32_t instructions);
  /// None took anything: the board has no counter.
  bool none() const { return periods_.empty() || periods_.rbegin()->first == 0; }
  /// Over all that were added, one at least.
  loop::InstructionRange range() const;

 private:
  std::map<std::uint32_t, std::uint64_t> periods_;  ///< by what they took
};

class ImageControl final : public loop::ControlPort {
 public:
  /// @param image             outlives this
  /// @param counts_per_instruction  of the board's counter, to an instruction or clock
  ImageControl(LockstepImage& image, double counts_per_instruction)
      : image_(image), counts_per_instruction_(counts_per_instruction) {}

  /// Nothing to do: the image has its targets compiled in, by carrier period.
  void set_target(double friction_ratio) override;

  /// @throws ImageError
  hal::Drive exchange(const hal::Sample& sample) override;
  /// @throws ImageError
  hal::ResonantDrive exchange(const hal::VibrationSample& sample) override;
  /// @throws ImageError
  hal::BiasedDrive exchange_biased(const hal::Sample& sample) override;
  /// @throws ImageError
  hal::BiasedDrive exchange_biased(const hal::MotionSample& sample) override;

  /// None: an image does not watch its signals.
  std::vector<numeric::SignalRecord> signals() const override;

  /// What the run has shown of the image: how many exchanges a second, the plant's time included and
  /// that of starting up not, and the cost of its steps.
  loop::ImageRecord record() const;

 private:
  using Clock = std::chrono::steady_clock;

  /// @param drive  its answer
  template <class Drive>
  Drive counted(const Drive& drive);

  LockstepImage& image_;
  double counts_per_instruction_;
  Clock::time_point first_answer_;
  Clock::time_point latest_answer_;
  std::uint64_t exchanges_ = 0;
  InstructionCount step_;
  InstructionCount answer_;
};

/// Builds and measures the image of a controller, runs the scene with it on an emulated board, and
/// once more with the controller in this process, which should come to the same drive commands.
///
/// @param experiment  in closed loop
/// @param header      of the same, as emulated::controller_header() writes it
/// @return with the image's record
/// @throws process::ProcessError  a tool is missing, or the build failed
/// @throws ImageError          the image did not answer, or not in order
/// @throws what loop::run() throws, besides
loop::RunResult run_image(const configure::Experiment& experiment, const EmulatedBoard& board,
                          const std::string& header, const loop::Watch& watch);

/// The same of an image that is built.
loop::RunResult run_emulator(const configure::Experiment& experiment, const EmulatedBoard& board,
                             const std::filesystem::path& image, const loop::Watch& watch);

/// Runs a scene with the image of its controller on a board that waits in lockstep at a serial port, and once
/// more with the controller in this process.
///
/// @param experiment  in closed loop, whose image it is
/// @throws ImageError  the board did not greet or answer, or not in order
/// @throws what loop::run() throws, besides
loop::RunResult run_board(const configure::Experiment& experiment, process::SerialPort& port,
                          const loop::Watch& watch);

/// @param result  of run_image() or run_board()
/// @throws loop::ComputationError  the image's drive commands are not the workstation's
void require_same(const loop::RunResult& result);

}  // namespace sonoglide::emulated
