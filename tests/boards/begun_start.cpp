// An image that defines begin_reset. It says in a line how often that came, what it found in static objects, and
// what they are in main; then it gives them other values, which a reset finds, and ends the line.
#include SONOGLIDE_BOARD_HEADER

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/encoding/decimal.hpp"
#include "hal/start/begin_reset.hpp"

namespace {

using Hardware = SONOGLIDE_BOARD_CLASS;
namespace encoding = sonoglide::encoding;

struct Found {
  std::uint32_t resets;  ///< any number after power-on
  std::uint32_t filled;
  std::uint32_t cleared;
};
[[gnu::section(".noinit")]] volatile Found found;
volatile std::uint32_t filled = 1001;
volatile std::uint32_t cleared;

void send(Hardware::ByteLink& bytes, std::uint32_t number, char end) {
  std::array<char, encoding::most_decimal_characters + 1> text{};
  const std::size_t size = encoding::write_decimal(number, 0, text.data());
  text[size] = end;
  for (std::size_t i = 0; i <= size; ++i) {
    while (!bytes.send(static_cast<std::uint8_t>(text[i]))) {
    }
  }
}

}  // namespace

extern "C" [[gnu::section(".boot")]] void begin_reset() {
  found.resets = found.resets + 1;
  found.filled = filled;
  found.cleared = cleared;
}

int main() {
  Hardware::ByteLink bytes;
  send(bytes, found.resets, ' ');
  send(bytes, found.filled, ' ');
  send(bytes, found.cleared, ' ');
  send(bytes, filled, ' ');
  send(bytes, cleared, ' ');
  filled = 2002;
  cleared = 3003;
  send(bytes, 0, '\n');  // the reset may come now
  return 0;
}
