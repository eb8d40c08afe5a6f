/// The last faults of a unit.
#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware/app/sequence_lock.hpp"

namespace sonoglide::app {

/// A fault, and when it was found.
struct FaultEntry {
  std::uint8_t fault;    ///< control::Fault or UnitFault
  std::uint32_t period;  ///< in which it was found: served since reset, this one included; wraps
};

/// Keeps the last `Length` faults since reset. One side adds, the other may read at any moment.
///
/// @tparam Word  std::atomic, or PlainWord where both sides are one
template <std::size_t Length, template <class> class Word>
class FaultLog {
 public:
  void add(const FaultEntry& entry) {
    words_.write_whole([&] {
      words_.write(2 * next_, entry.fault);
      words_.write(2 * next_ + 1, entry.period);
      next_ = next_ + 1 < Length ? next_ + 1 : 0;
      count_ += count_ < UINT32_MAX ? 1U : 0U;
      words_.write(count_at, count_);
      words_.write(next_at, static_cast<std::uint32_t>(next_));
    });
  }

  /// Faults since reset, those no longer kept included.
  std::uint32_t count() const { return words_.read(count_at); }
  std::size_t kept() const { return kept_of(count()); }

  /// @param age    0 is the latest
  /// @param entry  of no meaning where that many are not kept
  /// @param count  count() at the moment of the entry
  /// @return whether that many are kept
  bool read(std::size_t age, FaultEntry& entry, std::uint32_t& count) const {
    words_.read_whole([&] {
      count = words_.read(count_at);
      const std::size_t next = words_.read(next_at);
      const std::size_t at =
          next > age % Length ? next - 1 - age % Length : next + Length - 1 - age % Length;
      entry.fault = static_cast<std::uint8_t>(words_.read(2 * at));
      entry.period = words_.read(2 * at + 1);
    });
    return age < kept_of(count);
  }

  /// @param age  less than kept()
  FaultEntry entry(std::size_t age) const {
    FaultEntry result{};
    std::uint32_t count = 0;
    read(age, result, count);
    return result;
  }

 private:
  static constexpr std::size_t count_at = 2 * Length;
  static constexpr std::size_t next_at = count_at + 1;

  static std::size_t kept_of(std::uint32_t count) { return count < Length ? count : Length; }

  SequenceLock<2 * Length + 2, Word> words_;
  std::size_t next_ = 0;     ///< of the side that adds alone
  std::uint32_t count_ = 0;  ///< likewise
};

}  // namespace sonoglide::app
