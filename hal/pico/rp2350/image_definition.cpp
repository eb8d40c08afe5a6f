// What the boot ROM looks for in the first 4 KiB of the flash: a loop of blocks, here one, that says of the image that
// it is a program for this chip, Arm and secure. It then starts by the vector table at the begin of the flash.
// Source: Raspberry Pi, RP2350 Datasheet, bootrom: picobin, minimum image metadata.
#include <cstdint>

namespace {

constexpr std::uint32_t begin = 0xffffded3;
constexpr std::uint32_t end = 0xab123579;
constexpr std::uint32_t program = 1U << 0;
constexpr std::uint32_t secure = 2U << 4;
constexpr std::uint32_t for_rp2350 = 1U << 12;
constexpr std::uint32_t image_type = 0x42U | 1U << 8 | (program | secure | for_rp2350) << 16;
constexpr std::uint32_t last_item = 0xffU | 1U << 8;  // one word of items is before it
constexpr std::uint32_t to_next_block = 0;            // itself

}  // namespace

extern "C" {
[[gnu::section(".image_definition")]] extern const std::uint32_t image_definition[5];
const std::uint32_t image_definition[5] = {begin, image_type, last_item, to_next_block, end};
}
