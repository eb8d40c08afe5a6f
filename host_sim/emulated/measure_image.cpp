#include "host_sim/emulated/measure_image.hpp"

#include <fstream>
#include <iterator>

#include "host_sim/emulated/cross_tools.hpp"
#include "host_sim/process/run_tool.hpp"

namespace sonoglide::emulated {

ImageCost measure_image(const std::filesystem::path& image, const emulated::EmulatedBoard& board,
                        const process::Attention& attention) {
  std::ifstream file(image, std::ios::binary);
  const std::string elf{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const std::string disassembly = process::run_tool(
      {cross_tools(board).prefix + "objdump", "--disassemble", image.string()}, attention);
  ImageCost cost{image_size(elf), stack_bound(disassembly, "reset")};
  const StackBound exception = stack_bound(disassembly, "take_exception");
  cost.stack.bytes += exception_frame_bytes(elf) + exception.bytes;
  if (cost.stack.unbounded_by.empty()) {
    cost.stack.unbounded_by = exception.unbounded_by;
  }
  return cost;
}

}  // namespace sonoglide::emulated
