/// Serial line of the micro:bit, which its interface chip passes on to USB.
#pragma once

#include <cstdint>

namespace sonoglide::hal::microbit {

/// 115200 baud, 8 data bits, no parity, one stop bit.
class Uart {
 public:
  Uart();
  std::uint8_t receive();
  void send(std::uint8_t byte);
};

}  // namespace sonoglide::hal::microbit
