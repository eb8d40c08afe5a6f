// The first 256 bytes of the flash. The boot ROM copies them to RAM, compares their checksum and calls them:
// they make the flash readable in the address space and start what comes after them.
// Source: Raspberry Pi, RP2040 Datasheet, bootrom and SSI; Arm, ARMv6-M Architecture Reference Manual, for
// the instructions.
#include <array>
#include <cstddef>
#include <cstdint>

namespace {

constexpr std::size_t size = 256;
constexpr std::uint32_t after_it = 0x10000000 + size;

/// A word that is stored at an address.
struct Setting {
  std::uint32_t address;
  std::uint32_t value;
};

constexpr std::uint32_t ssi = 0x18000000;
constexpr std::uint32_t frames_of_32_bits = 31U << 16;
constexpr std::uint32_t read_after_address = 3U << 8;
constexpr std::uint32_t read_command = 0x03U << 24;  // every chip has it
constexpr std::uint32_t command_of_8_bits = 2U << 8;
constexpr std::uint32_t address_of_24_bits = 6U << 2;

constexpr Setting settings[] = {
    {ssi + 0x08, 0},  // off while it is set
    {ssi + 0x14, 4},  // clocks of the system in one of the chip
    {ssi + 0x00, frames_of_32_bits | read_after_address},
    {ssi + 0x04, 0},  // one frame in a read
    {ssi + 0xf4, read_command | command_of_8_bits | address_of_24_bits},
    {ssi + 0x08, 1},
    {0xe000ed08, after_it},  // the vector table
    {0, after_it},           // the end
};

constexpr std::uint16_t instructions[] = {
    0xa004,          //       adr   r0, settings
    0xc806,          // next: ldmia r0!, {r1, r2}
    0x2900,          //       cmp   r1, #0
    0xd001,          //       beq   end
    0x600a,          //       str   r2, [r1]
    0xe7fa,          //       b     next
    0xca03,          // end:  ldmia r2!, {r0, r1}
    0xf380, 0x8808,  //       msr   msp, r0
    0x4708,          //       bx    r1
};
static_assert(sizeof instructions == 4 + 4 * 4, "adr leads to what comes after the instructions");

using Bytes = std::array<std::uint8_t, size>;

constexpr void put(Bytes& bytes, std::size_t at, std::uint32_t value, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    bytes[at + i] = static_cast<std::uint8_t>(value >> (8 * i));
  }
}

/// CRC-32 with the polynomial 0x04c11db7, high bit first, begun with ones, not inverted.
constexpr std::uint32_t checksum(const Bytes& bytes, std::size_t count) {
  std::uint32_t result = 0xffffffff;
  for (std::size_t i = 0; i < count; ++i) {
    result ^= std::uint32_t{bytes[i]} << 24;
    for (int bit = 0; bit < 8; ++bit) {
      result = (result << 1) ^ ((result >> 31) * 0x04c11db7U);
    }
  }
  return result;
}

constexpr Bytes assemble() {
  Bytes bytes{};
  std::size_t at = 0;
  for (const std::uint16_t instruction : instructions) {
    put(bytes, at, instruction, 2);
    at += 2;
  }
  for (const Setting& setting : settings) {
    put(bytes, at, setting.address, 4);
    put(bytes, at + 4, setting.value, 4);
    at += 8;
  }
  put(bytes, size - 4, checksum(bytes, size - 4), 4);
  return bytes;
}

}  // namespace

extern "C" {
[[gnu::section(".second_stage"), gnu::aligned(4)]] extern const Bytes second_stage;
const Bytes second_stage = assemble();
}
