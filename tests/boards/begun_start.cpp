// An image that defines begin_reset. It says in a line how often that came, what it found in static objects, and
// what they are in main; then it gives them other values, which a reset finds, and ends the line.
#include SONOGLIDE_BOARD_HEADER

#include <cstdint>

#include "hal/start/begin_reset.hpp"
#include "send_number.hpp"

namespace {

using Hardware = SONOGLIDE_BOARD_CLASS;
using sonoglide::image_test::send;

struct Found {
  std::uint32_t resets;  ///< any number after power-on
  std::uint32_t filled;
  std::uint32_t cleared;
};
[[gnu::section(".noinit")]] volatile Found found;
volatile std::uint32_t filled = 1001;
volatile std::uint32_t cleared;

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
