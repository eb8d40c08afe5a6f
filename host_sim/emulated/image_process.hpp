/// A controller image on an emulated board, in lockstep.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host_sim/emulated/lockstep_image.hpp"
#include "host_sim/process/child_process.hpp"
#include "host_sim/process/pipe.hpp"

namespace sonoglide::emulated {

/// Runs an emulator with its standard input and output connected to this object. The emulator ends
/// with its owner, or with the owner's process.
class ImageProcess final : public LockstepImage {
 public:
  /// @param command   the emulator and its arguments
  /// @param patience  an answer that takes longer never comes
  /// @throws process::ProcessError  the emulator cannot be started
  ImageProcess(const std::vector<std::string>& command, std::chrono::milliseconds patience);

  void send(const std::uint8_t* bytes, std::size_t size) override;

  /// Ends the input and waits for the image to leave; to be called once, last.
  /// @return its exit code
  /// @throws ImageError  it does not leave in time, still sends something, or was ended by a
  /// signal
  int shut_down();

  /// Of the emulator.
  pid_t process() const { return child_->id(); }

 private:
  void receive(std::uint8_t* bytes, std::size_t size) override;
  void wait_for_answer();
  /// With the emulator's last words.
  [[noreturn]] void fail(const std::string& what) const override;
  std::string last_words() const;

  std::chrono::milliseconds patience_;
  process::Pipe samples_;
  process::Pipe drives_;
  process::Descriptor complaints_;
  std::optional<process::ChildProcess> child_;
};

}  // namespace sonoglide::emulated
