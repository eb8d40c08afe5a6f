/// A unit on an emulated board, which runs by itself.
#pragma once

#include <filesystem>
#include <string>

#include "host_sim/emulated/board_list.hpp"
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

}  // namespace sonoglide::emulated
