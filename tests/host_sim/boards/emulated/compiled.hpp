/// Small programs from the cross-compilers, to hold what is read from an image against.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "host_sim/process/child_process.hpp"

namespace sonoglide::emulated {

struct Compiler {
  std::string program;
  std::vector<std::string> flags;

  friend void PrintTo(const Compiler& compiler, std::ostream* stream) {
    *stream << compiler.flags.front();
  }

  /// Another program of the same tools.
  std::string tool(const std::string& name) const {
    return program.substr(0, program.size() - 3) + name;
  }
};

inline const Compiler arm{ARM_COMPILER,
                          {"-mcpu=cortex-m4", "-mfpu=fpv4-sp-d16", "-mfloat-abi=hard"}};
inline const Compiler small_arm{ARM_COMPILER, {"-mcpu=cortex-m0", "-mfloat-abi=soft"}};
inline const Compiler riscv{RISCV_COMPILER, {"-march=rv32imac", "-mabi=ilp32", "-misa-spec=2.2"}};

inline std::string content(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// A source, linked without start files, and what the compiler says of its stack.
class Compiled {
 public:
  Compiled(const Compiler& compiler, const std::string& source) : compiler_(compiler) {
    std::string name = testing::TempDir() + "sonoglide_image_XXXXXX";
    folder_ = mkdtemp(name.data());
    std::ofstream(folder_ / "a.cpp") << source;
    std::vector<std::string> command{compiler.program};
    command.insert(command.end(), compiler.flags.begin(), compiler.flags.end());
    for (const char* flag :
         {"-O2", "-fno-exceptions", "-fstack-usage", "-nostartfiles", "-nostdlib", "-e", "reset"}) {
      command.emplace_back(flag);
    }
    command.insert(command.end(), {(folder_ / "a.cpp").string(), "-lgcc", "-o", image().string()});
    process::run_tool(command, {});
  }
  ~Compiled() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  Compiled(const Compiled&) = delete;
  Compiled& operator=(const Compiled&) = delete;

  std::filesystem::path image() const { return folder_ / "a.elf"; }
  std::string disassembly() const {
    return process::run_tool({compiler_.tool("objdump"), "-d", image().string()}, {});
  }
  /// What GNU size says, one section a line.
  std::string sections() const {
    return process::run_tool({compiler_.tool("size"), "-A", "-d", image().string()}, {});
  }
  /// What the compiler says that a function's frame is.
  std::uint64_t frame_bytes(const std::string& function) const {
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      std::ifstream file(entry.path());
      for (std::string line; entry.path().extension() == ".su" && std::getline(file, line);) {
        const std::size_t tab = line.find('\t');
        if (line.find(function) < tab) {
          return std::stoull(line.substr(tab));
        }
      }
    }
    ADD_FAILURE() << "no frame of " << function;
    return 0;
  }

 private:
  Compiler compiler_;
  std::filesystem::path folder_;
};

}  // namespace sonoglide::emulated
