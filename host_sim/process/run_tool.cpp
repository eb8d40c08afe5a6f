#include "host_sim/process/run_tool.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <sstream>

#include "host_sim/process/child_process.hpp"
#include "host_sim/process/pipe.hpp"

namespace sonoglide::process {

std::filesystem::path require_program(const std::string& program, const std::string& package) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    std::filesystem::path candidate = std::filesystem::path(folder) / program;
    if (access(candidate.c_str(), X_OK) == 0) {
      return candidate;
    }
  }
  throw ProcessError(
      fmt::format("{}: is not installed; on Debian: apt-get install {}", program, package));
}

namespace {

/// A tool that has nothing to say for so long has hung.
constexpr std::chrono::minutes patience{10};

std::string read_to_the_end(const std::string& tool, int descriptor) {
  std::string text;
  std::array<char, 4096> part{};
  ssize_t count = 0;
  do {
    if (!wait_for_input(descriptor, patience)) {
      throw ProcessError(fmt::format("{} hung:\n{}", tool, text));
    }
    count = read(descriptor, part.data(), part.size());
    text.append(part.data(), static_cast<std::size_t>(std::max<ssize_t>(0, count)));
  } while (count > 0);
  return text;
}

}  // namespace

std::string run_tool(const std::vector<std::string>& command, std::string_view input) {
  constexpr std::size_t most_errors = 1U << 20U;
  const Descriptor asked = make_memory_file(input);
  const Descriptor errors = make_memory_file();
  Pipe said = make_pipe();
  ChildProcess tool(command, {asked.number(), said.write_end.number(), errors.number()});
  said.write_end.close();
  std::string text = read_to_the_end(command.front(), said.read_end.number());
  const int status = tool.wait();
  if (status != 0) {
    throw ProcessError(fmt::format("{} failed with {}:\n{}{}", command.front(),
                                   describe_end(status), text,
                                   memory_file_text(errors, most_errors)));
  }
  return text;
}

}  // namespace sonoglide::process
