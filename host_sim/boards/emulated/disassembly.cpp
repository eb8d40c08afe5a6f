#include "host_sim/boards/emulated/disassembly.hpp"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <sstream>

namespace sonoglide::emulated {
namespace {

constexpr int never = 1000;

/// Words of constants among the code, by address.
using Literals = std::map<std::uint64_t, std::int32_t>;

/// What is known of registers so far into a function.
struct Registers {
  std::map<std::string, std::int32_t> constants;
  int since_scaled_by_4 = never;  ///< instructions since an index was
  std::string popped;             ///< the one that has just been taken from the stack, alone
};

bool starts_with(const std::string& text, const char* beginning) {
  return text.rfind(beginning, 0) == 0;
}

/// One instruction as objdump prints it: `address: bytes <tab> mnemonic <tab> operands`.
struct Instruction {
  std::string mnemonic;
  std::string operands;
};

std::optional<Instruction> parse_instruction(const std::string& line) {
  std::istringstream columns(line);
  std::string place;
  std::string bytes;
  Instruction instruction;
  std::getline(columns, place, '\t');
  std::getline(columns, bytes, '\t');
  std::getline(columns, instruction.mnemonic, '\t');
  std::getline(columns, instruction.operands);
  if (place.empty() || place.back() != ':' || instruction.mnemonic.empty()) {
    return std::nullopt;
  }
  return instruction;
}

/// The symbol in `… <symbol+0x12>`, and whether its beginning is meant.
struct Target {
  std::string name;
  bool beginning = false;
};

std::optional<Target> target_of(const std::string& operands) {
  const std::size_t begin = operands.find('<');
  const std::size_t end = operands.rfind('>');
  if (begin == std::string::npos || end == std::string::npos) {
    return std::nullopt;
  }
  const std::string symbol = operands.substr(begin + 1, end - begin - 1);
  const std::size_t offset = symbol.rfind("+0x");
  return Target{symbol.substr(0, offset), offset == std::string::npos};
}

/// Bytes of a register list such as `{r4, r5, lr}` or `{d8-d15}`.
std::uint64_t list_bytes(const std::string& operands) {
  std::istringstream registers(operands.substr(operands.find('{') + 1));
  std::uint64_t bytes = 0;
  for (std::string item; std::getline(registers, item, ',');) {
    item.erase(0, item.find_first_not_of(' '));
    const std::uint64_t each = item[0] == 'd' ? 8 : 4;
    const std::size_t dash = item.find('-');
    const auto number = [&](std::size_t from) {
      return std::strtoul(item.c_str() + from, nullptr, 10);
    };
    bytes += each * (dash == std::string::npos ? 1 : number(dash + 2) - number(1) + 1);
  }
  return bytes;
}

/// Operands without the comment that objdump adds.
std::string without_comment(const std::string& operands) {
  const std::size_t comment =
      std::min({operands.find('@'), operands.find("# "), operands.find(';')});
  const std::string text = operands.substr(0, comment);
  return text.substr(0, text.find_last_not_of(" \t") + 1);
}

/// The last operand where it is a constant: `#16`, `-16`, `16`; nothing where it is a register.
std::optional<std::int64_t> last_constant(const std::string& operands) {
  const std::size_t separator = operands.find_last_of(", ");
  std::size_t begin = separator == std::string::npos ? 0 : separator + 1;
  begin += operands[begin] == '#' ? 1 : 0;
  char* end = nullptr;
  const std::int64_t value = std::strtoll(operands.c_str() + begin, &end, 10);
  return *end == '\0' && end != operands.c_str() + begin ? std::optional<std::int64_t>(value)
                                                         : std::nullopt;
}

bool is_branch(const std::string& mnemonic) {
  return mnemonic[0] == 'b' || mnemonic[0] == 'j' || starts_with(mnemonic, "cb");
}

bool links(const std::string& mnemonic) {
  return mnemonic == "bl" || mnemonic == "blx" || mnemonic == "jal" || mnemonic == "jalr";
}

/// A jump whose target is in a register, other than a return.
bool is_indirect(const Instruction& instruction) {
  const std::string& mnemonic = instruction.mnemonic;
  const std::string& operands = instruction.operands;
  const bool by_register = mnemonic == "bx" || starts_with(mnemonic, "blx") || mnemonic == "jr" ||
                           starts_with(mnemonic, "jalr");
  const bool into_counter = starts_with(mnemonic, "mov") && starts_with(operands, "pc");
  const bool from_memory = starts_with(mnemonic, "ldr") && starts_with(operands, "pc") &&
                           operands.find("[sp]") == std::string::npos;
  return (by_register && operands != "lr" && operands != "ra" && !target_of(operands)) ||
         into_counter || from_memory;
}

std::string last_operand(const std::string& operands) {
  return operands.substr(operands.find_last_of(", ") + 1);
}

/// What a sum with the stack pointer as its result puts there. A small core takes a large frame
/// from a register.
std::optional<std::uint64_t> added_bytes(const std::string& mnemonic, const std::string& operands,
                                         const Registers& registers) {
  std::optional<std::int64_t> constant = last_constant(operands);
  if (const auto known = registers.constants.find(last_operand(operands));
      known != registers.constants.end()) {
    constant = known->second;
  }
  if (!constant) {
    return std::nullopt;
  }
  const std::int64_t down = starts_with(mnemonic, "sub") ? *constant : -*constant;
  return static_cast<std::uint64_t>(std::max<std::int64_t>(0, down));
}

/// What an instruction puts on the stack; nothing where that is not known beforehand.
std::optional<std::uint64_t> pushed_bytes(const Instruction& instruction,
                                          const Registers& registers) {
  const std::string& mnemonic = instruction.mnemonic;
  const std::string operands = without_comment(instruction.operands);
  const bool stores_list = mnemonic.find("stmdb") != std::string::npos;
  if (starts_with(mnemonic, "push") || starts_with(mnemonic, "vpush") ||
      (stores_list && starts_with(operands, "sp!"))) {
    return list_bytes(operands);
  }
  const std::string write_back = "[sp, #-";
  const std::size_t place = operands.find(write_back);
  if (place != std::string::npos && operands.back() == '!') {
    return std::strtoul(operands.c_str() + place + write_back.size(), nullptr, 10);
  }
  if (!starts_with(operands, "sp,")) {
    return 0;
  }
  if (starts_with(mnemonic, "sub") || starts_with(mnemonic, "add")) {
    return added_bytes(mnemonic, operands, registers);
  }
  const bool moved = starts_with(mnemonic, "mov") || (mnemonic == "mv" && operands != "sp,sp");
  return moved ? std::nullopt : std::optional<std::uint64_t>(0);
}

/// A switch scales its index by the size of a table's entry, loads the entry and jumps there:
/// within the function, and a few instructions later.
bool is_switch(const Instruction& jump, const Registers& registers) {
  constexpr int table_access = 5;
  return !links(jump.mnemonic) && registers.since_scaled_by_4 <= table_access;
}

bool scales_by_4(const Instruction& instruction) {
  const std::string operands = without_comment(instruction.operands);
  const std::string ending =
      operands.substr(operands.size() - std::min<std::size_t>(3, operands.size()));
  return (starts_with(instruction.mnemonic, "lsl") || starts_with(instruction.mnemonic, "sll")) &&
         (ending == " #2" || ending == "0x2");
}

/// The literal that `ldr r4, [pc, #16]  @ (18e8 <f+0x39c>)` loads.
std::optional<std::int32_t> literal_of(const Instruction& instruction, const Literals& literals) {
  const std::string& operands = instruction.operands;
  const std::size_t place = operands.find("@ (");
  if (!starts_with(instruction.mnemonic, "ldr") || operands.find("[pc,") == std::string::npos ||
      place == std::string::npos) {
    return std::nullopt;
  }
  const auto literal = literals.find(std::strtoul(operands.c_str() + place + 3, nullptr, 16));
  return literal == literals.end() ? std::nullopt : std::optional(literal->second);
}

/// Of `r2, r2, #4`, but not of `r2, r3, #4`.
bool shifts_itself(const std::string& operands) {
  const std::size_t end = operands.find(',');
  return operands.compare(end + 1, end + 2, " " + operands.substr(0, end + 1)) == 0;
}

/// What a register holds after an instruction that names it first: a literal, a small constant, or
/// that constant shifted.
std::optional<std::int32_t> constant_left(const Instruction& instruction, const Literals& literals,
                                          const std::optional<std::int32_t>& before) {
  const auto operand = last_constant(without_comment(instruction.operands));
  if (instruction.mnemonic == "movs" && operand) {
    return static_cast<std::int32_t>(*operand);
  }
  if (instruction.mnemonic == "lsls" && operand && before && shifts_itself(instruction.operands)) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(*before) << (*operand % 32));
  }
  return literal_of(instruction, literals);
}

/// Whatever is written to a register replaces what was known of it.
void keep_constant(const Instruction& instruction, const Literals& literals, Registers& registers) {
  const std::string written = instruction.operands.substr(0, instruction.operands.find(','));
  const auto known = registers.constants.find(written);
  const auto left = constant_left(
      instruction, literals,
      known == registers.constants.end() ? std::nullopt : std::optional(known->second));
  if (left) {
    registers.constants[written] = *left;
  } else {
    registers.constants.erase(written);
  }
}

/// A small core whose return address lies under a caller's registers takes it to another register.
bool is_return(const Instruction& jump, const Registers& registers) {
  return jump.mnemonic == "bx" && jump.operands == registers.popped;
}

void keep_popped(const Instruction& instruction, Registers& registers) {
  const std::string& operands = instruction.operands;
  if (instruction.mnemonic == "pop") {
    registers.popped = operands.substr(1, operands.size() - 2);
  } else if (!starts_with(operands, "sp,")) {
    registers.popped.clear();
  }
}

void take(const Instruction& instruction, const Literals& literals, const std::string& name,
          Registers& registers, Function& function) {
  const std::optional<std::uint64_t> pushed = pushed_bytes(instruction, registers);
  keep_constant(instruction, literals, registers);
  function.frame_bytes += pushed.value_or(0);
  if (!pushed) {
    function.doubt = name + " takes a variable amount of stack";
  }
  registers.since_scaled_by_4 = scales_by_4(instruction) ? 0 : registers.since_scaled_by_4 + 1;
  if (is_indirect(instruction) && !is_switch(instruction, registers) &&
      !is_return(instruction, registers)) {
    function.doubt = name + " jumps through a pointer";
  }
  keep_popped(instruction, registers);
  const std::optional<Target> target = target_of(instruction.operands);
  if (is_branch(instruction.mnemonic) && target &&
      (target->name != name || (links(instruction.mnemonic) && target->beginning))) {
    function.calls.insert(target->name);
  }
}

/// A function begins with `address <name>:`.
std::optional<std::string> function_begun(const std::string& line) {
  const std::size_t bracket = line.find(" <");
  if (bracket == std::string::npos || line.size() < 3 || line.substr(line.size() - 2) != ">:") {
    return std::nullopt;
  }
  return line.substr(bracket + 2, line.size() - bracket - 4);
}

/// A constructor has two names in the C++ ABI (Itanium, 5.1.4.3), C1 and C2, for one function where there are no
/// virtual bases, and a destructor D1 and D2. The disassembly has one of them, a veneer may be called by the other.
std::string other_name(std::string name) {
  for (const char* const base : {"C2E", "D2E"}) {
    if (const std::size_t at = name.rfind(base); at != std::string::npos) {
      name[at + 1] = '1';
    }
  }
  return name;
}

/// The linker's way to a function that a branch does not reach is called `__<function>_veneer`: its one jump, through
/// a word beside it, leads there.
void see_through_veneer(const std::string& name, const Functions& all, Function& function) {
  const std::string beginning = "__";
  const std::string ending = "_veneer";
  const bool is_veneer = starts_with(name, beginning.c_str()) &&
                         name.size() > beginning.size() + ending.size() &&
                         name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
  if (is_veneer) {
    function.doubt.clear();
    const std::string target =
        name.substr(beginning.size(), name.size() - beginning.size() - ending.size());
    function.calls = {all.count(target) != 0 ? target : other_name(target)};
  }
}

/// Lines of the form `18e8: fffffbbc <tab> .word <tab> 0xfffffbbc`.
Literals literals_in(const std::string& disassembly) {
  Literals literals;
  std::istringstream lines(disassembly);
  for (std::string line; std::getline(lines, line);) {
    if (const auto word = parse_instruction(line); word && word->mnemonic == ".word") {
      literals[std::strtoul(line.c_str(), nullptr, 16)] =
          static_cast<std::int32_t>(std::strtoul(word->operands.c_str(), nullptr, 16));
    }
  }
  return literals;
}

}  // namespace

Functions functions_in(const std::string& disassembly) {
  const Literals literals = literals_in(disassembly);
  Functions functions;
  Registers registers;
  Functions::value_type* current = nullptr;
  std::istringstream lines(disassembly);
  for (std::string line; std::getline(lines, line);) {
    if (const auto name = function_begun(line)) {
      current = &*functions.try_emplace(*name).first;
      registers = {};
    } else if (const auto instruction = parse_instruction(line); instruction && current) {
      take(*instruction, literals, current->first, registers, current->second);
    }
  }
  for (auto& [name, function] : functions) {
    see_through_veneer(name, functions, function);
  }
  return functions;
}

}  // namespace sonoglide::emulated
