/// A board in lockstep at the other end of a serial line.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

#include "host_sim/emulated/lockstep_image.hpp"
#include "host_sim/process/serial_port.hpp"

namespace sonoglide::emulated {

class SerialImage final : public LockstepImage {
 public:
  /// @param port      outlives this
  /// @param patience  an answer that takes longer never comes
  SerialImage(process::SerialPort& port, std::chrono::milliseconds patience)
      : port_(port), patience_(patience) {}

  void send(const std::uint8_t* bytes, std::size_t size) override { port_.send(bytes, size); }

 private:
  void receive(std::uint8_t* bytes, std::size_t size) override;
  [[noreturn]] void fail(const std::string& what) const override;

  process::SerialPort& port_;
  std::chrono::milliseconds patience_;
};

}  // namespace sonoglide::emulated
