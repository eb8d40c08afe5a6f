/// Bytes between the processor and the flash chip, which is then not in the address space.
#pragma once

#include <cstdint>

namespace sonoglide::hal::pico {

void start_flash_link();

/// An instruction lasts for as long as its chip is selected.
void select_flash(bool selected);

/// @return what came back meanwhile
std::uint8_t exchange_with_flash(std::uint8_t byte);

}  // namespace sonoglide::hal::pico
