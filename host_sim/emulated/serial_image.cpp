#include "host_sim/emulated/serial_image.hpp"

#include <fmt/format.h>

#include "host_sim/process/printable.hpp"

namespace sonoglide::emulated {

void SerialImage::receive(std::uint8_t* bytes, std::size_t size) {
  while (size > 0) {
    const std::size_t count = port_.receive(bytes, size, patience_);
    if (count == 0) {
      fail(fmt::format("is silent for {} ms{}", patience_.count(),
                       period() > 0 ? ""
                                    : "; reset the board, which must hold what image --lockstep "
                                      "builds of this scene"));
    }
    bytes += count;
    size -= count;
  }
}

void SerialImage::fail(const std::string& what) const {
  throw ImageError(fmt::format("{}: carrier period {}: the board {}",
                               process::printable(port_.device()), period(), what));
}

}  // namespace sonoglide::emulated
