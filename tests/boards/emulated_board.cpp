#include "emulated_board.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "hal/lockstep/frame.hpp"

namespace sonoglide::boards {
namespace {

namespace lockstep = hal::lockstep;

/// Both ends of a connection.
std::array<int, 2> connection() {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw EmulatorError("no socket pair: " + std::string(std::strerror(errno)));
  }
  return ends;
}

constexpr int monitor_descriptor = 3;

[[noreturn]] void become(std::vector<std::string> command, int link, int monitor, pid_t parent) {
  command.insert(command.end(),
                 {"-chardev", "socket,id=monitor,fd=" + std::to_string(monitor_descriptor), "-mon",
                  "chardev=monitor,mode=readline"});
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (std::string& argument : command) {
    arguments.push_back(argument.data());
  }
  arguments.push_back(nullptr);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  // Copies, since either may stand where the other is to go.
  const int link_copy = fcntl(link, F_DUPFD_CLOEXEC, monitor_descriptor + 1);
  const int monitor_copy = fcntl(monitor, F_DUPFD_CLOEXEC, monitor_descriptor + 1);
  if (getppid() == parent && dup2(link_copy, STDIN_FILENO) >= 0 &&
      dup2(link_copy, STDOUT_FILENO) >= 0 && dup2(monitor_copy, monitor_descriptor) >= 0) {
    execvp(arguments.front(), arguments.data());
  }
  _exit(127);
}

std::string describe_end(int status) {
  if (WIFSIGNALED(status)) {
    return "the emulator was ended by signal " + std::to_string(WTERMSIG(status));
  }
  return "the emulator ended with exit code " + std::to_string(WEXITSTATUS(status));
}

}  // namespace

EmulatedBoard::EmulatedBoard(const std::vector<std::string>& command,
                             std::chrono::milliseconds time_limit)
    : deadline_(std::chrono::steady_clock::now() + time_limit) {
  const std::array<int, 2> link = connection();
  const std::array<int, 2> monitor = connection();
  link_ = link[0];
  monitor_ = monitor[0];
  const pid_t self = getpid();
  process_ = fork();
  if (process_ == 0) {
    become(command, link[1], monitor[1], self);
  }
  close(link[1]);
  close(monitor[1]);
  if (process_ < 0) {
    close(link_);
    close(monitor_);
    throw EmulatorError("no process: " + std::string(std::strerror(errno)));
  }
}

EmulatedBoard::~EmulatedBoard() {
  kill();
  close(link_);
  close(monitor_);
}

void EmulatedBoard::await_greeting() {
  std::uint8_t byte = 0;
  receive(&byte, 1);
  if (byte != lockstep::greeting) {
    throw EmulatorError("the board greets with " + std::to_string(byte));
  }
}

hal::Drive EmulatedBoard::exchange(const hal::Sample& sample) {
  const lockstep::SampleFrame question = lockstep::encode(period_, sample);
  send(question.data(), question.size());
  lockstep::DriveFrame answer{};
  receive(answer.data(), answer.size());
  if (lockstep::period(answer) != period_) {
    throw EmulatorError("carrier period " + std::to_string(period_) + " was answered as " +
                        std::to_string(lockstep::period(answer)));
  }
  ++period_;
  return lockstep::decode(answer);
}

void EmulatedBoard::send(const std::uint8_t* bytes, std::size_t size) {
  if (::send(link_, bytes, size, MSG_NOSIGNAL) != static_cast<ssize_t>(size)) {
    throw EmulatorError("the emulator takes no more samples; " + std::to_string(shut_down()) +
                        " is its exit code");
  }
}

std::string EmulatedBoard::receive_line() {
  std::string line;
  for (;;) {
    std::uint8_t byte = 0;
    receive(&byte, 1);
    if (byte == '\n') {
      return line;
    }
    if (byte != '\r') {
      line += static_cast<char>(byte);
    }
  }
}

void EmulatedBoard::request_reset() {
  const std::string command = "system_reset\n";
  if (::send(monitor_, command.data(), command.size(), MSG_NOSIGNAL) < 0) {
    throw EmulatorError("the emulator's monitor takes no command");
  }
}

int EmulatedBoard::shut_down() {
  shutdown(link_, SHUT_WR);
  return await_end();
}

int EmulatedBoard::await_end() {
  if (process_ < 0) {
    throw EmulatorError("the emulator has ended before");
  }
  // The output ends when the emulator does.
  std::array<std::uint8_t, lockstep::drive_frame_size> rest{};
  do {
    wait_readable();
  } while (read(link_, rest.data(), rest.size()) > 0);
  int status = 0;
  waitpid(process_, &status, 0);
  process_ = -1;
  if (!WIFEXITED(status)) {
    throw EmulatorError(describe_end(status));
  }
  return WEXITSTATUS(status);
}

void EmulatedBoard::receive(std::uint8_t* bytes, std::size_t size) {
  while (size > 0) {
    wait_readable();
    const ssize_t count = read(link_, bytes, size);
    if (count <= 0) {
      throw EmulatorError("the emulator ended with exit code " + std::to_string(shut_down()) +
                          " in carrier period " + std::to_string(period_));
    }
    bytes += count;
    size -= static_cast<std::size_t>(count);
  }
}

void EmulatedBoard::wait_readable() {
  using std::chrono::milliseconds;
  const auto left =
      std::chrono::duration_cast<milliseconds>(deadline_ - std::chrono::steady_clock::now());
  pollfd link{link_, POLLIN, 0};
  const int ready = poll(&link, 1, static_cast<int>(std::max<std::int64_t>(0, left.count())));
  if (ready < 1) {
    kill();
    throw EmulatorError("the emulator hung in carrier period " + std::to_string(period_) +
                        " and was killed");
  }
}

void EmulatedBoard::kill() {
  if (process_ > 0) {
    ::kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
    process_ = -1;
  }
}

}  // namespace sonoglide::boards
