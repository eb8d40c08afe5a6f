/// The one way in which a signal ends the program: at once, whatever it is computing, with nothing
/// left behind.
#pragma once

#include <array>
#include <atomic>
#include <csignal>
#include <functional>
#include <mutex>
#include <thread>

namespace sonoglide::process {

/// While one lives, a signal does not end the program; it ends when the last one is gone. For steps
/// that belong together: to make a folder and to say that it is to be undone, to move a set of files.
/// Any thread may hold several.
class Undisturbed {
 public:
  Undisturbed();

 private:
  std::lock_guard<std::recursive_mutex> lock_;
};

/// What is done where a signal ends the program while this lives.
class Undo {
 public:
  /// @param action  called on another thread, with all others still at work; takes no lock that they
  ///                may hold, and throws nothing
  explicit Undo(std::function<void()> action);
  /// Where the program is being ended, it does not return.
  ~Undo();
  Undo(const Undo&) = delete;
  Undo& operator=(const Undo&) = delete;

 private:
  friend class SignalWatch;
  std::function<void()> action_;
};

/// Waits for SIGINT, SIGTERM and SIGHUP, but for those that the process ignores, on a thread of its
/// own. When one comes, every Undo that lives is done, the newest first, and the process ends as the
/// signal ends one. SIGPIPE and SIGXFSZ are ignored meanwhile: who writes is told by an error.
///
/// One at a time, made before any other thread. Threads and tools that were started meanwhile end
/// before it.
class SignalWatch {
 public:
  SignalWatch();
  ~SignalWatch();
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;

 private:
  static constexpr std::array<int, 3> ending = {SIGINT, SIGTERM, SIGHUP};
  static constexpr std::array<int, 2> told = {SIGPIPE, SIGXFSZ};

  void wait() const;

  sigset_t awaited_{};
  sigset_t previous_mask_{};
  std::array<struct sigaction, told.size()> previous_{};
  std::atomic<bool> over_{false};
  std::thread thread_;
};

}  // namespace sonoglide::process
