/// What the functions of an image put on the stack and call, read from its instructions.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>

namespace sonoglide::emulated {

struct Function {
  std::uint64_t frame_bytes = 0;  ///< all that it may put on the stack, whatever way is taken
  std::set<std::string> calls;
  std::string doubt;  ///< why its depth is not known; empty where it is
};

using Functions = std::map<std::string, Function>;

/// @param disassembly  as GNU objdump -d prints it, for Thumb or RISC-V
Functions functions_in(const std::string& disassembly);

}  // namespace sonoglide::emulated
