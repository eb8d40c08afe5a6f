#include "host_sim/process/child_process.hpp"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "host_sim/process/pipe.hpp"

namespace sonoglide::process {
namespace {

std::vector<char*> argument_list(const std::vector<std::string>& command) {
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& argument : command) {
    arguments.push_back(const_cast<char*>(argument.c_str()));
  }
  arguments.push_back(nullptr);
  return arguments;
}

/// An ignored signal stays ignored in a new program, and a blocked one blocked: none of that is the
/// child's.
void clear_signals() {
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
    std::signal(signal, SIG_DFL);
  }
}

/// Only what is safe between fork and exec.
[[noreturn]] void become(char* const* arguments, const Streams& streams, int complaints,
                         pid_t parent) {
  clear_signals();
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const bool connected =
      setpgid(0, 0) == 0 && getppid() == parent && dup2(streams.input, STDIN_FILENO) >= 0 &&
      dup2(streams.output, STDOUT_FILENO) >= 0 && dup2(streams.errors, STDERR_FILENO) >= 0;
  if (connected) {
    execvp(arguments[0], arguments);
  }
  const int reason = errno;
  const ssize_t told = write(complaints, &reason, sizeof reason);
  _exit(told == sizeof reason ? 127 : 126);
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command, const Streams& streams) {
  const std::vector<char*> arguments = argument_list(command);
  Pipe complaints = make_pipe();
  const pid_t self = getpid();
  id_ = fork();
  if (id_ == 0) {
    become(arguments.data(), streams, complaints.write_end.number(), self);
  }
  if (id_ < 0) {
    throw ProcessError(fmt::format("{}: {}", command.front(), std::strerror(errno)));
  }
  complaints.write_end.close();
  // The pipe closes when the program has been started.
  int reason = 0;
  ssize_t count = 0;
  do {
    count = read(complaints.read_end.number(), &reason, sizeof reason);
  } while (count < 0 && errno == EINTR);
  if (count > 0) {
    wait();
    throw ProcessError(
        fmt::format("{}: cannot be started: {}", command.front(), std::strerror(reason)));
  }
}

ChildProcess::~ChildProcess() {
  kill();
}

int ChildProcess::wait() {
  int status = 0;
  while (waitpid(id_, &status, 0) < 0 && errno == EINTR) {
  }
  id_ = -1;
  return status;
}

void ChildProcess::kill() {
  if (id_ > 0) {
    ::kill(-id_, SIGKILL);
    wait();
  }
}

std::string describe_end(int status) {
  return WIFSIGNALED(status) ? fmt::format("signal {}", WTERMSIG(status))
                             : fmt::format("exit code {}", WEXITSTATUS(status));
}

OneCore::OneCore() {
  const int core = sched_getcpu();
  if (core < 0 || core >= CPU_SETSIZE || sched_getaffinity(0, sizeof previous_, &previous_) != 0) {
    return;
  }
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(static_cast<unsigned>(core), &one);
  changed_ = sched_setaffinity(0, sizeof one, &one) == 0;
}

OneCore::~OneCore() {
  if (changed_) {
    sched_setaffinity(0, sizeof previous_, &previous_);
  }
}

}  // namespace sonoglide::process
