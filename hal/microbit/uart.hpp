/// Serial line of the micro:bit, which its interface chip passes on to USB.
#pragma once

#include <cstdint>

namespace sonoglide::hal::microbit {

/// A byte link, see hal/board.hpp: 115200 baud, 8 data bits, no parity, one stop bit.
class Uart {
 public:
  Uart();
  bool receive(std::uint8_t& byte);
  bool send(std::uint8_t byte);

 private:
  bool sending_ = false;
};

}  // namespace sonoglide::hal::microbit
