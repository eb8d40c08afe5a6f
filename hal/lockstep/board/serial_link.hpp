/// Lockstep over a serial line: no debugger needed.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hal/lockstep/frame.hpp"

namespace sonoglide::hal::lockstep {

/// The line carries frames back to back, after greetings from the board. It has no end.
///
/// @tparam ByteLink  see hal/board.hpp; once constructed, it hears.
template <class ByteLink>
class SerialLink {
 public:
  SerialLink() { write(&greeting, 1); }

  std::size_t read(std::uint8_t* bytes, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) {
      wait_for(bytes[i]);
    }
    return size;
  }

  bool write(const std::uint8_t* bytes, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) {
      while (!line_.send(bytes[i])) {
      }
    }
    return true;
  }

 private:
  static constexpr std::uint32_t polls_between_greetings = 1U << 20;

  void wait_for(std::uint8_t& byte) {
    std::uint32_t polls = 0;
    while (!line_.receive(byte)) {
      ++polls;
      if (!heard_ && polls % polls_between_greetings == 0) {
        line_.send(greeting);
      }
    }
    heard_ = true;
  }

  ByteLink line_{};
  bool heard_ = false;
};

}  // namespace sonoglide::hal::lockstep
