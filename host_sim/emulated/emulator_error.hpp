/// An emulator that cannot go on.
#pragma once

#include <stdexcept>

namespace sonoglide::emulated {

/// The emulator died, hung or answered out of turn; what() says which, in which carrier period, and
/// what the emulator said last.
class EmulatorError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace sonoglide::emulated
