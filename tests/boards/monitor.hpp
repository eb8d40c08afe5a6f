/// The emulator's own console, by which a test does to a board what a hand would do.
#pragma once

#include <string>
#include <vector>

#include "host_sim/process/descriptor.hpp"

namespace sonoglide::pil {

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

 private:
  std::string path_;
  process::Descriptor to_emulator_;
};

}  // namespace sonoglide::pil
