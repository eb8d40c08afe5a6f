#include "monitor.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <stdexcept>
#include <string_view>

namespace sonoglide::pil {
namespace {

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
  make_named_pipe(path_ + "/pipe.out");
  // For reading too: so it opens before the emulator does.
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
  constexpr std::string_view command = "system_reset\n";
  if (write(to_emulator_.number(), command.data(), command.size()) < 0) {
    throw std::runtime_error("the emulator's monitor takes no command");
  }
}

}  // namespace sonoglide::pil
