#include <elf.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <set>

#include "host_sim/boards/emulated/disassembly.hpp"
#include "host_sim/boards/emulated/image.hpp"
#include "host_sim/process/child_process.hpp"

namespace sonoglide::emulated {
namespace {

/// Walks the calls, each function once.
class DeepestPath {
 public:
  explicit DeepestPath(const Functions& functions) : functions_(functions) {}

  StackBound from(const std::string& name) {
    const auto known = bounds_.find(name);
    if (known != bounds_.end()) {
      return known->second;
    }
    if (!open_.insert(name).second) {
      return {0, name + " calls itself"};
    }
    StackBound bound = below(name);
    open_.erase(name);
    bounds_[name] = bound;
    return bound;
  }

 private:
  StackBound below(const std::string& name) {
    const auto found = functions_.find(name);
    if (found == functions_.end()) {
      return {0, name + " is not in the image"};
    }
    const Function& function = found->second;
    StackBound bound{function.frame_bytes, function.doubt};
    for (const std::string& called : function.calls) {
      const StackBound deeper = from(called);
      bound.bytes = std::max(bound.bytes, function.frame_bytes + deeper.bytes);
      if (bound.unbounded_by.empty()) {
        bound.unbounded_by = deeper.unbounded_by;
      }
    }
    return bound;
  }

  const Functions& functions_;
  std::map<std::string, StackBound> bounds_;
  std::set<std::string> open_;
};

}  // namespace

StackBound stack_bound(const std::string& disassembly, const std::string& entry) {
  const Functions functions = functions_in(disassembly);
  return DeepestPath(functions).from(entry);
}

namespace {

/// A structure of the file, copied out: nothing in it need be aligned.
template <class Structure>
Structure at(std::string_view elf, std::size_t offset) {
  Structure structure{};
  if (offset > elf.size() || elf.size() - offset < sizeof structure) {
    throw process::ProcessError("the image is cut short");
  }
  std::memcpy(&structure, elf.data() + offset, sizeof structure);
  return structure;
}

Elf32_Ehdr header_of(std::string_view elf) {
  const auto header = at<Elf32_Ehdr>(elf, 0);
  if (std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0 || header.e_ident[EI_CLASS] != ELFCLASS32 ||
      header.e_ident[EI_DATA] != ELFDATA2LSB) {
    throw process::ProcessError("the image is no 32-bit ELF file");
  }
  return header;
}

}  // namespace

ImageSize image_size(std::string_view elf) {
  const Elf32_Ehdr header = header_of(elf);
  ImageSize size;
  for (std::size_t i = 0; i < header.e_shnum; ++i) {
    const auto section = at<Elf32_Shdr>(elf, header.e_shoff + i * header.e_shentsize);
    if ((section.sh_flags & SHF_ALLOC) == 0) {
      continue;
    }
    // Values to begin with are kept in flash and copied.
    size.flash_bytes += section.sh_type == SHT_NOBITS ? 0 : section.sh_size;
    size.ram_bytes += (section.sh_flags & SHF_WRITE) == 0 ? 0 : section.sh_size;
  }
  return size;
}

std::uint64_t exception_frame_bytes(std::string_view elf) {
  constexpr std::uint64_t integer_registers = 32;
  constexpr std::uint64_t float_registers = 72;
  constexpr std::uint64_t alignment = 4;
  const Elf32_Ehdr header = header_of(elf);
  if (header.e_machine != EM_ARM) {
    return 0;
  }
  const bool float_unit = (header.e_flags & EF_ARM_ABI_FLOAT_HARD) != 0;
  return integer_registers + (float_unit ? float_registers : 0) + alignment;
}

ImageCost measure_image(const std::filesystem::path& image, const ImageBoard& board) {
  const std::string elf = content(image);
  const std::string disassembly =
      process::run_tool({cross_tools(board).prefix + "objdump", "--disassemble", image.string()});
  ImageCost cost{image_size(elf), stack_bound(disassembly, "reset")};
  std::vector<std::string> handlers{"take_exception"};
  if (disassembly.find("<take_carrier>:") != std::string::npos) {
    handlers.emplace_back("take_carrier");
  }
  for (const std::string& handler : handlers) {
    const StackBound exception = stack_bound(disassembly, handler);
    cost.stack.bytes += exception_frame_bytes(elf) + exception.bytes;
    if (cost.stack.unbounded_by.empty()) {
      cost.stack.unbounded_by = exception.unbounded_by;
    }
  }
  return cost;
}

}  // namespace sonoglide::emulated
