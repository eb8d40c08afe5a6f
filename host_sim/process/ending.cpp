#include "host_sim/process/ending.hpp"

#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

namespace sonoglide::process {
namespace {

struct Registry {
  std::recursive_mutex mutex;
  std::vector<const Undo*> undos;  ///< the newest last
};

/// Outlives every thread: never destroyed.
Registry& registry() {
  static auto* const only = new Registry;
  return *only;
}

/// What an ended tool had started itself is this process's by then, and on its way out.
void wait_for_the_last() {
  constexpr std::chrono::seconds patience{2};
  constexpr std::chrono::milliseconds between_looks{5};
  for (auto waited = between_looks.zero(); waited < patience; waited += between_looks) {
    pid_t gone = 0;
    while ((gone = waitpid(-1, nullptr, WNOHANG)) > 0) {
    }
    if (gone < 0) {
      return;
    }
    std::this_thread::sleep_for(between_looks);
  }
}

/// Ends the process as the signal does where nobody waits for it.
[[noreturn]] void end_by(int signal) {
  std::signal(signal, SIG_DFL);
  sigset_t one;
  sigemptyset(&one);
  sigaddset(&one, signal);
  std::raise(signal);
  pthread_sigmask(SIG_UNBLOCK, &one, nullptr);
  std::abort();
}

}  // namespace

Undisturbed::Undisturbed() : lock_(registry().mutex) {}

Undo::Undo(std::function<void()> action) : action_(std::move(action)) {
  const Undisturbed now;
  registry().undos.push_back(this);
}

Undo::~Undo() {
  const Undisturbed now;
  std::vector<const Undo*>& undos = registry().undos;
  undos.erase(std::find(undos.begin(), undos.end(), this));
}

SignalWatch::SignalWatch() {
  sigemptyset(&awaited_);
  for (const int signal : ending) {
    struct sigaction action {};
    sigaction(signal, nullptr, &action);
    if (action.sa_handler != SIG_IGN) {
      sigaddset(&awaited_, signal);
    }
  }
  struct sigaction ignore {};
  ignore.sa_handler = SIG_IGN;
  for (std::size_t i = 0; i < told.size(); ++i) {
    sigaction(told[i], &ignore, &previous_[i]);
  }
  sigaddset(&awaited_, SIGRTMIN);
  pthread_sigmask(SIG_BLOCK, &awaited_, &previous_mask_);
  thread_ = std::thread([this] { wait(); });
}

SignalWatch::~SignalWatch() {
  over_ = true;
  pthread_kill(thread_.native_handle(), SIGRTMIN);  // which nobody ignores
  thread_.join();
  pthread_sigmask(SIG_SETMASK, &previous_mask_, nullptr);
  for (std::size_t i = 0; i < told.size(); ++i) {
    sigaction(told[i], &previous_[i], nullptr);
  }
}

void SignalWatch::wait() const {
  int signal = 0;
  sigwait(&awaited_, &signal);
  if (over_) {
    return;
  }
  const Undisturbed for_good;
  const std::vector<const Undo*>& undos = registry().undos;
  std::for_each(undos.rbegin(), undos.rend(), [](const Undo* undo) { undo->action_(); });
  wait_for_the_last();
  end_by(signal);
}

}  // namespace sonoglide::process
