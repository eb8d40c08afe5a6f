#include "monitor.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

#include "host_sim/process/pipe.hpp"

namespace sonoglide::emulated {
namespace {

using std::chrono_literals::operator""s;

constexpr mode_t owner_only = 0600;

std::string temporary_folder() {
  std::string path = testing::TempDir() + "monitorXXXXXX";
  if (mkdtemp(path.data()) == nullptr) {
    throw std::runtime_error("no temporary folder");
  }
  return path;
}

std::string make_named_pipe(const std::string& path) {
  if (mkfifo(path.c_str(), owner_only) != 0) {
    throw std::runtime_error("no named pipe");
  }
  return path;
}

}  // namespace

Monitor::Monitor() : path_(temporary_folder()) {
  // Both ways: so they open before the emulator opens them.
  const std::string output = make_named_pipe(path_ + "/pipe.out");
  from_emulator_ = process::Descriptor(open(output.c_str(), O_RDWR | O_CLOEXEC));
  const std::string input = make_named_pipe(path_ + "/pipe.in");
  to_emulator_ = process::Descriptor(open(input.c_str(), O_RDWR | O_CLOEXEC));
}

Monitor::~Monitor() {
  unlink((path_ + "/pipe.in").c_str());
  unlink((path_ + "/pipe.out").c_str());
  rmdir(path_.c_str());
}

std::vector<std::string> Monitor::arguments() const {
  return {"-chardev", "pipe,id=monitor,path=" + path_ + "/pipe", "-mon",
          "chardev=monitor,mode=readline"};
}

void Monitor::request_reset() {
  type("system_reset\n");
}

std::uint32_t Monitor::word(std::uint32_t address) {
  type("xp /1xw " + std::to_string(address) + "\n");
  // It echoes what is typed, and answers "20000010: 0x00000000".
  constexpr std::string_view before = ": 0x";
  constexpr std::size_t digits = 8;
  std::string answer;
  std::size_t at = std::string::npos;
  while (at == std::string::npos || answer.size() < at + before.size() + digits) {
    answer += next();
    at = answer.find(before);
  }
  return static_cast<std::uint32_t>(
      std::stoul(answer.substr(at + before.size(), digits), nullptr, 16));
}

void Monitor::type(const std::string& command) {
  if (write(to_emulator_.number(), command.data(), command.size()) < 0) {
    throw std::runtime_error("the emulator's monitor takes no command");
  }
}

char Monitor::next() {
  char character = '\0';
  if (!process::wait_for_input(from_emulator_.number(), 60s) ||
      read(from_emulator_.number(), &character, 1) != 1) {
    throw std::runtime_error("the emulator's monitor does not answer");
  }
  return character;
}

}  // namespace sonoglide::emulated
