/// An atomic word at each access of which the other side of a unit may come in between, as an interrupt.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace sonoglide::app {

/// Plays every way in which calls of an interrupt fall between the accesses of a program.
class Interleavings {
 public:
  /// Runs the program again and again, each time with other interrupts.
  /// @param begin       makes everything anew
  /// @param program     what is interrupted
  /// @param interrupt   the interrupt
  /// @param end         checks the result
  /// @param most        interrupts in one run
  /// @return the runs
  static std::size_t play(const std::function<void()>& begin, const std::function<void()>& program,
                          const std::function<void()>& interrupt, const std::function<void()>& end,
                          int most) {
    std::size_t runs = 0;
    std::vector<int> choices;  // interrupts at each access, as far as they are fixed
    do {
      begin();
      Interleavings run{choices, interrupt, most};
      current() = &run;
      program();
      current() = nullptr;
      end();
      ++runs;
      choices = run.taken_;
    } while (advance(choices, most));
    return runs;
  }

  /// The interrupt comes while the program does nothing: nothing interrupts it.
  static void interrupt_idle_program() {
    Interleavings* const run = std::exchange(current(), nullptr);
    run->interrupt_();
    current() = run;
  }

  /// An access of the program; those of an interrupt are not interrupted.
  static void access() {
    if (current() != nullptr) {
      current()->pass();
    }
  }

 private:
  Interleavings(std::vector<int> fixed, std::function<void()> interrupt, int most)
      : fixed_(std::move(fixed)), interrupt_(std::move(interrupt)), left_(most) {}

  static Interleavings*& current() {
    static Interleavings* run = nullptr;
    return run;
  }

  void pass() {
    const int times = taken_.size() < fixed_.size() ? fixed_[taken_.size()] : 0;
    taken_.push_back(times);
    left_ -= times;
    current() = nullptr;
    for (int i = 0; i < times; ++i) {
      interrupt_();
    }
    current() = this;
  }

  /// The next run: one interrupt more at the last access that may have one.
  static bool advance(std::vector<int>& choices, int most) {
    int used = 0;
    for (const int times : choices) {
      used += times;
    }
    while (!choices.empty()) {
      if (used < most) {
        ++choices.back();
        return true;
      }
      used -= choices.back();
      choices.pop_back();
      // What was used behind this place is free again.
      if (!choices.empty() && used < most) {
        ++choices.back();
        return true;
      }
    }
    return false;
  }

  std::vector<int> fixed_;
  std::vector<int> taken_;
  std::function<void()> interrupt_;
  int left_;
};

template <class T>
class PreemptedAtomic {
 public:
  constexpr PreemptedAtomic() = default;
  constexpr PreemptedAtomic(T value)
      : value_(value) {}  // NOLINT(google-explicit-constructor): as std's

  T load(std::memory_order /*order*/) const {
    Interleavings::access();
    return value_;
  }
  void store(T value, std::memory_order /*order*/) {
    Interleavings::access();
    value_ = value;
  }

 private:
  T value_{};
};

}  // namespace sonoglide::app
