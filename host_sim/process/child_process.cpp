#include "host_sim/process/child_process.hpp"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <thread>

#include "host_sim/process/pipe.hpp"

namespace sonoglide::process {
namespace {

/// As exec takes texts; they outlive the list.
std::vector<char*> list_of(const std::vector<std::string>& texts) {
  std::vector<char*> list;
  list.reserve(texts.size() + 1);
  for (const std::string& text : texts) {
    list.push_back(const_cast<char*>(text.c_str()));
  }
  list.push_back(nullptr);
  return list;
}

std::vector<std::string> tool_environment() {
  std::vector<std::string> variables{"LC_ALL=C.UTF-8"};
  for (const char* name : {"PATH", "HOME", "TMPDIR", "LD_LIBRARY_PATH", "CCACHE_DIR",
                           "CMAKE_C_COMPILER_LAUNCHER", "CMAKE_CXX_COMPILER_LAUNCHER"}) {
    if (const char* value = std::getenv(name)) {
      variables.push_back(fmt::format("{}={}", name, value));
    }
  }
  return variables;
}

/// An ignored signal stays ignored in a new program, and a blocked one blocked: none of that is the
/// child's.
void clear_signals() {
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ}) {
    std::signal(signal, SIG_DFL);
  }
}

/// Only what is safe between fork and exec.
[[noreturn]] void become(char* const* arguments, char* const* environment, const Streams& streams,
                         int complaints, pid_t parent) {
  clear_signals();
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const bool connected =
      setpgid(0, 0) == 0 && getppid() == parent && dup2(streams.input, STDIN_FILENO) >= 0 &&
      dup2(streams.output, STDOUT_FILENO) >= 0 && dup2(streams.errors, STDERR_FILENO) >= 0;
  if (connected) {
    execvpe(arguments[0], arguments, environment);
  }
  const int reason = errno;
  const ssize_t told = write(complaints, &reason, sizeof reason);
  _exit(told == sizeof reason ? 127 : 126);
}

/// A build tool ends what it has started when it is asked to, not when it is killed.
void end_group(pid_t id, int signal) {
  constexpr std::chrono::seconds grace{2};
  constexpr std::chrono::milliseconds between_looks{5};
  // Who loses its parent in the group becomes a child of this process, and is waited for.
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  kill(-id, signal);
  kill(-id, SIGCONT);
  for (auto waited = between_looks.zero(); waited < grace; waited += between_looks) {
    pid_t gone = 0;
    while ((gone = waitpid(-id, nullptr, WNOHANG)) > 0) {
    }
    if (gone < 0 && errno == ECHILD) {
      return;
    }
    std::this_thread::sleep_for(between_looks);
  }
  kill(-id, SIGKILL);
  while (waitpid(-id, nullptr, 0) > 0 || errno == EINTR) {
  }
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command, const Streams& streams,
                           int end_signal)
    : end_signal_(end_signal) {
  const std::vector<char*> arguments = list_of(command);
  const std::vector<std::string> variables = tool_environment();
  const std::vector<char*> environment = list_of(variables);
  Pipe complaints = make_pipe();
  const pid_t self = getpid();
  const Undisturbed now;
  id_ = fork();
  if (id_ == 0) {
    become(arguments.data(), environment.data(), streams, complaints.write_end.number(), self);
  }
  if (id_ < 0) {
    throw ProcessError(fmt::format("{}: {}", command.front(), std::strerror(errno)));
  }
  undo_.emplace([id = id_, end_signal] { end_group(id, end_signal); });
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
  end();
}

int ChildProcess::wait() {
  siginfo_t ended{};
  while (waitid(P_PID, static_cast<id_t>(id_), &ended, WEXITED | WNOWAIT) < 0 && errno == EINTR) {
  }
  const Undisturbed now;
  int status = 0;
  waitpid(id_, &status, 0);
  id_ = -1;
  undo_.reset();
  return status;
}

void ChildProcess::end() {
  if (id_ > 0) {
    const Undisturbed now;
    end_group(id_, end_signal_);
    id_ = -1;
    undo_.reset();
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
constexpr std::chrono::minutes longest_run{10};

std::string read_to_the_end(const std::string& tool, int descriptor) {
  std::string text;
  std::array<char, 4096> part{};
  ssize_t count = 0;
  do {
    if (!wait_for_input(descriptor, longest_run)) {
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
