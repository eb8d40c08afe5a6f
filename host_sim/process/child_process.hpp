/// Another program, run by this one.
#pragma once

#include <sched.h>
#include <sys/types.h>

#include <string>
#include <vector>

namespace sonoglide::process {

/// What a child gets as its standard streams; descriptors of this process, which keeps them.
struct Streams {
  int input;
  int output;
  int errors;
};

/// Starts a program in a process group of its own, so that a Ctrl-C reaches this process alone,
/// which then ends the other. The destructor kills the whole group. Should this process be killed
/// itself, the system kills the child.
class ChildProcess {
 public:
  /// @param command  the program, looked for in PATH, and its arguments
  /// @throws ProcessError  the program cannot be started
  ChildProcess(const std::vector<std::string>& command, const Streams& streams);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Negative once the child has been waited for.
  pid_t id() const { return id_; }

  /// Waits for the end; to be called once. Blocks until the child ends.
  /// @return the status as of waitpid
  int wait();

  /// Ends the child and what it has started, if it still runs.
  void kill();

 private:
  pid_t id_ = -1;
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

}  // namespace sonoglide::process
