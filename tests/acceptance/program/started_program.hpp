/// The built program while it runs, to be interrupted.
#pragma once

#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance {

/// The program in a folder, its standard output nowhere and its temporary files where the folder
/// says; killed with its owner.
class StartedProgram {
 public:
  /// @param temporary  becomes TMPDIR
  StartedProgram(const ScratchFolder& folder, std::vector<std::string> arguments,
                 const ScratchFolder& temporary);
  ~StartedProgram();
  StartedProgram(const StartedProgram&) = delete;
  StartedProgram& operator=(const StartedProgram&) = delete;

  void send(int signal) const;
  /// Whether it has come to an end, at once.
  bool has_ended() const;
  /// Waits for its end.
  /// @return the status as of waitpid
  int end();

 private:
  pid_t process_;
};

/// The signals that end the program act again: tests that are started by nohup, or in the background
/// by a script, ignore some of them, and so would the program.
void heed_signals();

/// Looks again and again, for five minutes; whether the condition came true.
bool comes_true(const std::function<bool()>& condition);

}  // namespace sonoglide::acceptance
