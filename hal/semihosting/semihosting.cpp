#include "hal/semihosting/semihosting.hpp"

// Source: Arm, Semihosting for AArch32 and AArch64, release 2.0.
namespace sonoglide::hal::semihosting {
namespace {

static_assert(sizeof(std::uintptr_t) == 4, "a parameter block is made of 32-bit words");

enum Operation : std::int32_t {
  sys_open = 0x01,
  sys_write = 0x05,
  sys_read = 0x06,
  sys_exit = 0x20
};

constexpr std::uintptr_t open_mode_read = 0;
constexpr std::uintptr_t open_mode_write = 4;
constexpr std::uintptr_t application_exit = 0x20026;

std::uintptr_t word(std::int32_t handle) {
  return static_cast<std::uintptr_t>(handle);
}

std::uintptr_t word(const void* address) {
  return reinterpret_cast<std::uintptr_t>(address);
}

std::int32_t open_console(std::uintptr_t mode) {
  constexpr char name[] = ":tt";
  const std::uintptr_t block[] = {word(name), mode, sizeof name - 1};
  return trap(sys_open, block);
}

}  // namespace

std::int32_t open_standard_input() {
  return open_console(open_mode_read);
}

std::int32_t open_standard_output() {
  return open_console(open_mode_write);
}

std::size_t read_all(std::int32_t handle, void* bytes, std::size_t size) {
  std::size_t missing = size;
  while (missing > 0) {
    const std::uintptr_t block[] = {word(handle), word(bytes) + (size - missing), missing};
    const auto left = static_cast<std::size_t>(trap(sys_read, block));
    if (left >= missing) {
      break;
    }
    missing = left;
  }
  return size - missing;
}

bool write_all(std::int32_t handle, const void* bytes, std::size_t size) {
  const std::uintptr_t block[] = {word(handle), word(bytes), size};
  return trap(sys_write, block) == 0;
}

void leave(int code) {
  const std::uintptr_t block[] = {application_exit, word(code)};
  trap(sys_exit, block);
  for (;;) {
  }
}

}  // namespace sonoglide::hal::semihosting
