#include "tests/host_sim/boards/unit/terminal/pseudo_terminal.hpp"

namespace sonoglide::unit {

PseudoTerminal::PseudoTerminal() : master_(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
  if (grantpt(number()) != 0 || unlockpt(number()) != 0) {
    throw std::runtime_error("no pseudo-terminal is left");
  }
  device_ = ptsname(number());
  // Open all the time: else the other end hangs up with whoever leaves.
  held_ = process::Descriptor(open(device_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC));
  termios raw{};
  tcgetattr(held_.number(), &raw);
  cfmakeraw(&raw);
  tcsetattr(held_.number(), TCSANOW, &raw);
}

}  // namespace sonoglide::unit
