/// The emulator's own console, by which a test does to a board what a hand would do.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host_sim/process/pipe.hpp"

namespace sonoglide::emulated {

/// Two named pipes in the folder of temporary files, gone with this object.
class Monitor {
 public:
  Monitor();
  ~Monitor();
  Monitor(const Monitor&) = delete;
  Monitor& operator=(const Monitor&) = delete;

  /// What connects an emulator to this monitor.
  std::vector<std::string> arguments() const;

  /// Asks for a reset of the board, which comes soon.
  void request_reset();

  /// The word at an address of the board's memory.
  std::uint32_t word(std::uint32_t address);

 private:
  void type(const std::string& command);
  char next();

  std::string path_;
  process::Descriptor to_emulator_;
  process::Descriptor from_emulator_;
};

}  // namespace sonoglide::emulated
