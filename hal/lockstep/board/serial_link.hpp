/// Lockstep over a serial line: no debugger needed.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hal/lockstep/frame.hpp"

namespace sonoglide::hal::lockstep {

/// The line carries frames back to back, after one greeting from the board. It has no end.
///
/// @tparam ByteLink  see hal/board.hpp; once constructed, it hears.
template <class ByteLink>
class SerialLink {
 public:
  SerialLink() { write(&greeting, 1); }

  std::size_t read(std::uint8_t* bytes, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) {
      while (!line_.receive(bytes[i])) {
      }
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
  ByteLink line_{};
};

}  // namespace sonoglide::hal::lockstep
