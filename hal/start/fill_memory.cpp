#include "hal/start/fill_memory.hpp"

#include <cstdint>

extern "C" {

// Addresses from sections.ld.
extern const std::uint32_t data_image[];
extern std::uint32_t data_begin[];
extern std::uint32_t data_end[];
extern std::uint32_t bss_begin[];
extern std::uint32_t bss_end[];

void fill_memory() {
  const std::uint32_t* from = data_image;
  for (std::uint32_t* to = data_begin; to != data_end; ++to) {
    *to = *from++;
  }
  for (std::uint32_t* to = bss_begin; to != bss_end; ++to) {
    *to = 0;
  }
}

}  // extern "C"
