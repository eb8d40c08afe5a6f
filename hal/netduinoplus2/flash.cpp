#include "hal/netduinoplus2/board.hpp"

// Source: ST, RM0090, embedded flash memory interface; supply of 2.7 V and more: 32 bits at a time.
namespace sonoglide::hal::netduinoplus2 {
namespace {

struct FlashRegisters {
  volatile std::uint32_t access;
  volatile std::uint32_t key;
  volatile std::uint32_t option_key;
  volatile std::uint32_t status;
  volatile std::uint32_t control;
};
static_assert(offsetof(FlashRegisters, control) == 0x10);

constexpr std::size_t sector_words = 32768;

// Addresses from memory.ld.
extern "C" {
extern FlashRegisters flash_control;
extern volatile std::uint32_t parameter_sectors[2][sector_words];
}

constexpr std::uint32_t first_sector = 10;
constexpr std::uint32_t first_key = 0x45670123;
constexpr std::uint32_t second_key = 0xcdef89ab;
constexpr std::uint32_t programming = 1U << 0;
constexpr std::uint32_t erasing = 1U << 1;
constexpr unsigned sector_position = 3;
constexpr std::uint32_t words = 2U << 8;
constexpr std::uint32_t start = 1U << 16;
constexpr std::uint32_t locked = 1U << 31;
constexpr std::uint32_t busy_bit = 1U << 16;
constexpr std::uint32_t every_error = 0xf3;  // a set bit clears it

/// Unlocks the flash controller while this lives. Its end finishes the last operation and locks the
/// controller.
class Unlocked {
 public:
  Unlocked() {
    // A key that it does not ask for locks it until a reset.
    if ((flash_control.control & locked) != 0) {
      flash_control.key = first_key;
      flash_control.key = second_key;
    }
    flash_control.status = every_error;
  }
  ~Unlocked() {
    while ((flash_control.status & busy_bit) != 0) {
    }
    flash_control.control = locked;
  }
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;
};

}  // namespace

std::uint32_t Flash::read(std::size_t page, std::size_t word) const {
  return parameter_sectors[page][word];
}

void Flash::erase(std::size_t page) {
  const auto sector = first_sector + static_cast<std::uint32_t>(page);
  const std::uint32_t order = words | erasing | sector << sector_position;
  Watchdog::wait_long();
  {
    const Unlocked unlocked;
    flash_control.control = order;
    flash_control.control = order | start;
  }
  Watchdog::wait_short();
}

void Flash::program(std::size_t page, std::size_t word, std::uint32_t value) {
  const Unlocked unlocked;
  flash_control.control = words | programming;
  parameter_sectors[page][word] = value;
}

bool Flash::busy() const {
  return (flash_control.status & busy_bit) != 0;
}

}  // namespace sonoglide::hal::netduinoplus2
