/// Another program, run by this one.
#pragma once

#include <sched.h>
#include <sys/types.h>

#include <csignal>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host_sim/process/ending.hpp"
#include "host_sim/process/pipe.hpp"

namespace sonoglide::process {

/// What a child gets as its standard streams; descriptors of this process, which keeps them.
struct Streams {
  int input;
  int output;
  int errors;
};

/// Starts a program in a process group of its own, so that a Ctrl-C reaches this process alone,
/// which then ends the other. The destructor ends the whole group, and so does a signal that ends
/// this process. Should this process be killed itself, the system kills the child.
///
/// Of the environment the program gets what it needs to be found and to find its own parts (PATH,
/// HOME, TMPDIR, LD_LIBRARY_PATH, and what caches compilations), in the locale C.UTF-8: what it does
/// depends on no other setting of the user.
class ChildProcess {
 public:
  /// @param command     the program, looked for in PATH, and its arguments
  /// @param end_signal  what end() sends; SIGKILL to a program that starts no other and may not hear
  /// @throws ProcessError  the program cannot be started
  ChildProcess(const std::vector<std::string>& command, const Streams& streams,
               int end_signal = SIGTERM);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Negative once the child has been waited for.
  pid_t id() const { return id_; }

  /// Waits for the end; to be called once. Blocks until the child ends.
  /// @return the status as of waitpid
  int wait();

  /// Ends the child and what it has started, if it still runs: by the end signal, and by SIGKILL
  /// what is there two seconds later.
  void end();

 private:
  pid_t id_ = -1;
  int end_signal_;
  std::optional<Undo> undo_;  ///< while it has not been waited for
};

/// "exit code 1" or "signal 9", from a status of waitpid.
std::string describe_end(int status);

/// Keeps the calling thread, and every process that it starts meanwhile, on the core that it is on.
/// In lockstep one side always sleeps until the other has spoken: waking it on the same core takes
/// a quarter of the time. Not for a side that looks again and again instead of sleeping. Where the
/// system does not allow it, nothing changes.
class OneCore {
 public:
  OneCore();
  ~OneCore();
  OneCore(const OneCore&) = delete;
  OneCore& operator=(const OneCore&) = delete;

 private:
  cpu_set_t previous_{};
  bool changed_ = false;
};

// Tools: where they are, and running them to their end for what they do and say.

/// @param package  of Debian, that has the program
/// @return the program's place in PATH
/// @throws ProcessError  it has none
std::filesystem::path require_program(const std::string& program, const std::string& package);

/// Runs a tool to its end.
/// @param input  on its standard input
/// @return what it wrote on its standard output
/// @throws ProcessError  it cannot be started, or did not end with exit code 0; what() has all that
///         it wrote, errors last
std::string run_tool(const std::vector<std::string>& command, std::string_view input = {});

}  // namespace sonoglide::process
