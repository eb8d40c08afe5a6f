/// A unit on an emulated board: as it runs by itself, and what it takes in a period.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "host_sim/boards/emulated/board_list.hpp"
#include "host_sim/configure/experiment.hpp"
#include "host_sim/loop/watch.hpp"
#include "host_sim/process/child_process.hpp"
#include "host_sim/process/pipe.hpp"

namespace sonoglide::emulated {

/// Runs an emulator with the board's serial line at a pseudo-terminal. The emulator ends with its owner,
/// or with the owner's process.
class EmulatedUnit {
 public:
  /// @param image  of a unit on the board's own timer, an ELF file
  /// @throws process::ProcessError  the emulator cannot be started, or has no serial line
  EmulatedUnit(const EmulatedBoard& board, const std::filesystem::path& image);

  /// Of the serial line.
  const std::string& device() const { return device_; }

  /// Of the emulator.
  pid_t process() const { return emulator_.id(); }

 private:
  std::string await_device();

  process::Descriptor nothing_;
  process::Pipe said_;
  process::Descriptor complaints_;
  process::ChildProcess emulator_;
  std::string device_;
};

/// What the control side of a unit takes in a period, as an emulator counts it.
struct UnitSteps {
  std::uint32_t median = 0;
  std::uint32_t most = 0;
  std::uint64_t steps = 0;  ///< that were counted
  /// Clocks in a carrier period, where these are clocks; 0: they are instructions.
  std::uint32_t period_clocks = 0;
};

/// Of a board in lockstep the unit meets the samples of its scene, and comes to the commands of the workstation.
/// Of one that makes the carrier itself it meets a stand-in for the contact, from a restart on.
///
/// @param board   its emulator is installed
/// @param unit    its image, which the former does not need
/// @param header  as controller_header() writes it
/// @throws process::ProcessError   the build failed, or the emulator
/// @throws ImageError           the image did not answer, or not in order
/// @throws loop::ComputationError  its commands are not the workstation's, or the solver failed
UnitSteps unit_steps(const EmulatedBoard& board, const std::filesystem::path& unit,
                     const std::string& header, const configure::Experiment& experiment,
                     const loop::Watch& watch);

}  // namespace sonoglide::emulated
