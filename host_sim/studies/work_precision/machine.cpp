#include "host_sim/studies/work_precision/machine.hpp"

#include <fmt/format.h>
#include <sys/utsname.h>

#include <fstream>

namespace sonoglide::work_precision {
namespace {

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  std::string line;
  while (std::getline(file, line)) {
    const std::size_t colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos) {
      return line.substr(colon + 2);
    }
  }
  return "unknown processor";
}

std::string architecture() {
  utsname system{};
  return uname(&system) == 0 ? std::string(system.machine) : std::string("unknown architecture");
}

constexpr const char* compiler_name() {
#ifdef __clang__
  return "clang";
#else
  return "gcc";
#endif
}

constexpr const char* optimisation() {
#ifdef __OPTIMIZE__
  return "optimised";
#else
  return "not optimised: the times mean nothing";
#endif
}

}  // namespace

std::string machine() {
  return fmt::format("{}, {}, {} {}, {}", processor(), architecture(), compiler_name(), __VERSION__,
                     optimisation());
}

}  // namespace sonoglide::work_precision
