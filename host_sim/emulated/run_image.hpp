/// A closed loop with the real image of its controller.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "host_sim/configure/experiment.hpp"
#include "host_sim/emulated/board_list.hpp"
#include "host_sim/emulated/image_process.hpp"
#include "host_sim/loop/control_port.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/loop/run_result.hpp"
#include "host_sim/process/child_process.hpp"
#include "host_sim/process/pipe.hpp"

namespace sonoglide::emulated {

// The controller of a scene as an image on an emulated board, where a simulation meets it.

/// What a stretch of an image takes, period by period.
class InstructionCount {
 public:
  void add(std::uint32_t instructions);
  /// Over all that were added, one at least.
  loop::InstructionRange range() const;

 private:
  std::map<std::uint32_t, std::uint64_t> periods_;  ///< by what they took
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
  /// @throws EmulatorError
  hal::BiasedDrive exchange_biased(const hal::Sample& sample) override;
  /// @throws EmulatorError
  hal::BiasedDrive exchange_biased(const hal::MotionSample& sample) override;

  /// None: an image does not watch its signals.
  std::vector<numeric::SignalRecord> signals() const override;

  /// Ends the image.
  /// @return what the run showed of it: how many exchanges a second, the plant's time included and
  ///         that of starting up not, and the cost of its steps
  /// @throws EmulatorError  it does not leave as it should
  loop::ImageRecord shut_down();

 private:
  using Clock = std::chrono::steady_clock;

  /// @param drive  its answer
  template <class Drive>
  Drive counted(const Drive& drive);

  const emulated::EmulatedBoard& board_;
  process::OneCore core_;
  ImageProcess image_;
  Clock::time_point first_answer_;
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
/// @throws EmulatorError          the image did not answer, or not in order
/// @throws what loop::run() throws, besides
loop::RunResult run_image(const configure::Experiment& experiment,
                          const emulated::EmulatedBoard& board, const std::string& header,
                          const loop::Watch& watch);

/// @param result  of run_image()
/// @throws loop::ComputationError  the image's drive commands are not the workstation's
void require_same(const loop::RunResult& result);

}  // namespace sonoglide::emulated
