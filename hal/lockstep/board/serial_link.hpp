/// Lockstep over a serial line: no debugger needed.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hal/lockstep/frame.hpp"

namespace sonoglide::hal::lockstep {

/// The line carries frames back to back, after one greeting from the board. It has no end.
///
/// @tparam Uart  once constructed, it hears; it offers
///   std::uint8_t receive();        // waits for a byte
///   void send(std::uint8_t byte);  // waits until the line takes it
template <class Uart>
class SerialLink {
 public:
  SerialLink() { uart_.send(greeting); }

  std::size_t read(std::uint8_t* bytes, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) {
      bytes[i] = uart_.receive();
    }
    return size;
  }

  bool write(const std::uint8_t* bytes, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) {
      uart_.send(bytes[i]);
    }
    return true;
  }

 private:
  Uart uart_{};
};

}  // namespace sonoglide::hal::lockstep
