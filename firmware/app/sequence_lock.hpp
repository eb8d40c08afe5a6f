/// Words that one side writes at any moment and the other reads whole, without a lock.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace sonoglide::app {

/// A word that no other side reads at the same moment, in the place of an atomic one: what nobody asks for is
/// then left out of an image.
template <class T>
class PlainWord {
 public:
  constexpr PlainWord() = default;
  constexpr PlainWord(T value) : value_(value) {}  // NOLINT(google-explicit-constructor): as std's

  T load(std::memory_order /*order*/) const { return value_; }
  void store(T value, std::memory_order /*order*/) { value_ = value; }

 private:
  T value_{};
};

/// A word of two sides of which one interrupts the other, on one processor: in the place of an atomic one, which
/// has barriers for other processors. The compiler alone is kept from moving what comes before or after it.
template <class T>
class InterruptedWord {
 public:
  constexpr InterruptedWord() = default;
  constexpr InterruptedWord(T value)
      : value_(value) {}  // NOLINT(google-explicit-constructor): as std's

  T load(std::memory_order /*order*/) const {
    const T value = value_;
    std::atomic_signal_fence(std::memory_order_acquire);
    return value;
  }
  void store(T value, std::memory_order /*order*/) {
    std::atomic_signal_fence(std::memory_order_release);
    value_ = value;
  }

 private:
  volatile T value_{};
};

/// The writer, an interrupt or another thread, never waits. The reader reads again where the writer
/// came in between; it must not interrupt the writer.
///
/// Source: Boehm, Can Seqlocks Get Along with Programming Language Memory Models?, MSPC 2012: the words
/// themselves are atomic, and released one by one, so that no barrier stands alone.
template <std::size_t Words, template <class> class Atomic = std::atomic>
class SequenceLock {
 public:
  // ---- The writer's ----

  /// Calls `give`. Inside, write() takes the words.
  template <class Give>
  void write_whole(const Give& give) {
    const std::uint32_t before = sequence_.load(std::memory_order_relaxed);
    sequence_.store(before + 1, std::memory_order_relaxed);
    give();
    sequence_.store(before + 2, std::memory_order_release);
  }
  void write(std::size_t word, std::uint32_t value) {
    words_[word].store(value, std::memory_order_release);
  }

  // ---- The reader's ----

  /// Calls `take`, again until no write fell into it. Inside, read() gives the words.
  template <class Take>
  void read_whole(const Take& take) const {
    std::uint32_t before = 0;
    do {
      before = sequence_.load(std::memory_order_acquire);
      take();
    } while (before % 2 != 0 || sequence_.load(std::memory_order_relaxed) != before);
  }
  std::uint32_t read(std::size_t word) const {
    return words_[word].load(std::memory_order_acquire);
  }

 private:
  std::array<Atomic<std::uint32_t>, Words> words_{};
  Atomic<std::uint32_t> sequence_{0};  ///< odd while the writer writes
};

}  // namespace sonoglide::app
