#include "tests/acceptance/program/started_program.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

namespace sonoglide::acceptance {

void heed_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    std::signal(signal, SIG_DFL);
  }
}

StartedProgram::StartedProgram(const ScratchFolder& folder, std::vector<std::string> arguments,
                               const ScratchFolder& temporary) {
  std::string name = "sonoglide";
  std::vector<char*> words{name.data()};
  for (std::string& argument : arguments) {
    words.push_back(argument.data());
  }
  words.push_back(nullptr);
  process_ = fork();
  if (process_ == 0) {
    heed_signals();
    const int nowhere = open("/dev/null", O_WRONLY);
    setenv("TMPDIR", temporary.path().c_str(), 1);
    if (chdir(folder.path().c_str()) == 0 && dup2(nowhere, STDOUT_FILENO) >= 0) {
      execv(SONOGLIDE_PROGRAM, words.data());
    }
    _exit(127);
  }
}

StartedProgram::~StartedProgram() {
  if (process_ > 0) {
    send(SIGKILL);
    end();
  }
}

void StartedProgram::send(int signal) const {
  kill(process_, signal);
}

bool StartedProgram::has_ended() const {
  siginfo_t state = {};
  waitid(P_PID, static_cast<id_t>(process_), &state, WEXITED | WNOHANG | WNOWAIT);
  return state.si_pid == process_;
}

int StartedProgram::end() {
  int status = 0;
  waitpid(process_, &status, 0);
  process_ = 0;
  return status;
}

bool comes_true(const std::function<bool()>& condition) {
  constexpr int most_looks = 60'000;
  for (int i = 0; i < most_looks; ++i) {
    if (condition()) {
      return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

}  // namespace sonoglide::acceptance
