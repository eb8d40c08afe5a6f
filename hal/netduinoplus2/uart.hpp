/// USART1 of the STM32F405, on pins PA9 (out) and PA10 (in).
#pragma once

#include <cstdint>

namespace sonoglide::hal::netduinoplus2 {

/// A byte link, see hal/board.hpp: 115200 baud, 8 data bits, no parity, one stop bit.
class Uart {
 public:
  Uart();
  bool receive(std::uint8_t& byte);
  bool send(std::uint8_t byte);
};

}  // namespace sonoglide::hal::netduinoplus2
