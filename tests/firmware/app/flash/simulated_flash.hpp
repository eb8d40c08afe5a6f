/// NOR flash of two pages whose power can be cut in the middle of any operation.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>

namespace sonoglide::app {

/// What a cut operation leaves behind.
enum class Torn {
  untouched,    ///< as before the operation
  arbitrary,    ///< erase: any bits; program: any of the bits that were to be cleared are
  half_way,     ///< erase: the first half of the words; program: the low half of the bits
  all_but_one,  ///< one bit is missing
  few_bits,     ///< a few bits of each word have changed
  done,         ///< as after the operation
};

inline constexpr std::array<Torn, 6> every_tear = {Torn::untouched, Torn::arbitrary,
                                                   Torn::half_way,  Torn::all_but_one,
                                                   Torn::few_bits,  Torn::done};

/// Erasing sets every bit of a page, programming only clears bits; a word is programmed once
/// between erasures. Operations take effect at once and keep the flash busy for a few calls;
/// without power there is none.
class SimulatedFlash {
 public:
  static constexpr std::size_t page_words = 64;

  SimulatedFlash() {
    for (auto& page : pages_) {
      page.fill(erased);
    }
  }

  std::uint32_t read(std::size_t page, std::size_t word) const { return pages_.at(page).at(word); }

  void erase(std::size_t page) {
    if (!begin()) {
      return;
    }
    Page& words = pages_.at(page);
    const Page before = words;
    words.fill(erased);
    if (cut_now()) {
      tear_erase(before, words);
    }
  }

  void program(std::size_t page, std::size_t word, std::uint32_t value) {
    if (!begin()) {
      return;
    }
    std::uint32_t& cell = pages_.at(page).at(word);
    misused_ = misused_ || cell != erased;
    cell = cut_now() ? torn_program(value) : value;
    if (worn_) {
      cell = erased;
    }
  }

  bool busy() const { return hung_ || (busy_calls_ > 0 && busy_calls_-- > 0); }

  /// Cuts the power in the operation after `operations` more.
  void cut_after(int operations, Torn torn) {
    operations_left_ = operations;
    torn_ = torn;
  }
  bool powered() const { return powered_; }
  void restore_power() {
    powered_ = true;
    operations_left_ = -1;
    busy_calls_ = 0;
  }

  /// Programs no more.
  void wear_out() { worn_ = true; }
  /// Stays busy, or answers again.
  void hang(bool hangs = true) { hung_ = hangs; }
  /// Operations begun.
  int operations() const { return operations_; }
  /// A word was programmed twice, or an operation begun while another was going on.
  bool misused() const { return misused_; }
  std::array<std::uint32_t, page_words>& page(std::size_t page) { return pages_.at(page); }

 private:
  using Page = std::array<std::uint32_t, page_words>;
  static constexpr std::uint32_t erased = 0xFFFFFFFFU;

  bool begin() {
    misused_ = misused_ || busy_calls_ > 0;
    busy_calls_ = 3;
    operations_ += powered_ ? 1 : 0;
    return powered_;
  }

  bool cut_now() {
    powered_ = operations_left_ != 0;
    operations_left_ -= operations_left_ > 0 ? 1 : 0;
    return !powered_;
  }

  std::uint32_t random() { return static_cast<std::uint32_t>(generator_() << 16 ^ generator_()); }

  std::uint32_t few_bits() { return random() & random() & random(); }

  void tear_erase(const Page& before, Page& words) {
    for (std::size_t i = 0; i < page_words; ++i) {
      switch (torn_) {
        case Torn::untouched:
          words[i] = before[i];
          break;
        case Torn::arbitrary:
          words[i] = random();
          break;
        case Torn::half_way:
          words[i] = i < page_words / 2 ? erased : before[i];
          break;
        case Torn::all_but_one:
          words[i] = i == 0 ? erased - 1 : erased;
          break;
        case Torn::few_bits:
          words[i] = before[i] | few_bits();
          break;
        case Torn::done:
          break;
      }
    }
  }

  std::uint32_t torn_program(std::uint32_t value) {
    switch (torn_) {
      case Torn::untouched:
        return erased;
      case Torn::arbitrary:
        return value | random();
      case Torn::half_way:
        return value | 0xFFFF0000U;
      case Torn::all_but_one:
        return value | (~value & (value + 1));  // the lowest bit that was to be cleared
      case Torn::few_bits:
        return value | ~few_bits();
      case Torn::done:
        break;
    }
    return value;
  }

  std::array<Page, 2> pages_{};
  mutable int busy_calls_ = 0;
  int operations_left_ = -1;
  int operations_ = 0;
  Torn torn_ = Torn::done;
  bool powered_ = true;
  bool worn_ = false;
  bool hung_ = false;
  bool misused_ = false;
  std::minstd_rand generator_{1};
};

}  // namespace sonoglide::app
