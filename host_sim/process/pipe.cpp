#include "host_sim/process/pipe.hpp"

#include <fcntl.h>
#include <poll.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <string>

namespace sonoglide::process {

Pipe make_pipe() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw ProcessError(std::string("no pipe can be made: ") + std::strerror(errno));
  }
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

bool wait_for_input(int descriptor, std::chrono::milliseconds limit, const Attention& attention) {
  // A signal between a look and the wait after it shows at the next look.
  constexpr std::chrono::milliseconds between_looks{100};
  std::chrono::milliseconds left = limit;
  while (true) {
    const std::chrono::milliseconds slice = std::min(left, between_looks);
    pollfd input{descriptor, POLLIN, 0};
    const int ready = poll(&input, 1, static_cast<int>(slice.count()));
    if (ready > 0) {
      return true;
    }
    if (attention) {
      attention();
    }
    if (ready == 0) {
      left -= slice;
      if (left.count() <= 0) {
        return false;
      }
    }
  }
}

}  // namespace sonoglide::process
