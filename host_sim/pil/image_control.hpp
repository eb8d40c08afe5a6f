/// The controller of a scene as an image on an emulated board, where a simulation meets it.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host_sim/loop/control_port.hpp"
#include "host_sim/pil/image_process.hpp"
#include "host_sim/pil/one_core.hpp"

namespace sonoglide::pil {

class ImageControl final : public loop::ControlPort {
 public:
  /// @param command    the emulator with the image
  /// @param attention  called now and then while waiting; what it throws ends the wait
  /// @throws process::ProcessError  the emulator cannot be started
  ImageControl(const std::vector<std::string>& command, const process::Attention& attention);

  /// Nothing to do: the image has its targets compiled in, by carrier period.
  void set_target(double friction_ratio) override;

  /// @throws EmulatorError
  hal::Drive exchange(const hal::Sample& sample) override;

  /// None: an image does not watch its signals.
  std::vector<numeric::SignalRecord> signals() const override;

  /// Ends the image.
  /// @return carrier periods in a second, the plant's time included, that of starting up not; null
  ///         after less than two
  /// @throws EmulatorError  it does not leave as it should
  std::optional<double> shut_down();

 private:
  using Clock = std::chrono::steady_clock;

  OneCore core_;
  ImageProcess image_;
  Clock::time_point first_answer_;
  std::uint64_t exchanges_ = 0;
};

}  // namespace sonoglide::pil
