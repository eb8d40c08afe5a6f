/// How deep the stack of an image can get.
#pragma once

#include <cstdint>
#include <string>

namespace sonoglide::emulated {

/// Either a bound, or why there is none.
struct StackBound {
  std::uint64_t bytes = 0;
  std::string unbounded_by;  ///< empty, or what calls itself, is called indirectly or grows freely
};

/// The deepest path through the calls of a disassembled image. A function counts with all that it
/// may put on the stack, whatever way is taken through it.
///
/// It is read from the image's own instructions, so that start-up code and the compiler's library
/// are in it. A call through a pointer, a recursion and a frame of variable size leave no bound.
///
/// @param disassembly  as GNU objdump -d prints it, for Thumb or RISC-V
/// @param entry        the function that the path begins with
StackBound stack_bound(const std::string& disassembly, const std::string& entry);

}  // namespace sonoglide::emulated
