/// The last faults of a unit.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace sonoglide::app {

/// A fault, and when it was found.
struct FaultEntry {
  std::uint8_t fault;    ///< control::Fault or UnitFault
  std::uint32_t period;  ///< in which it was found: served since reset, this one included; wraps
};

/// Keeps the last `Length` faults since reset.
template <std::size_t Length>
class FaultLog {
 public:
  void add(const FaultEntry& entry) {
    entries_[next_] = entry;
    next_ = next_ + 1 < Length ? next_ + 1 : 0;
    count_ += count_ < UINT32_MAX ? 1U : 0U;
  }

  /// Faults since reset, those no longer kept included.
  std::uint32_t count() const { return count_; }
  std::size_t kept() const { return count_ < Length ? count_ : Length; }

  /// @param age  0 is the latest; less than kept().
  const FaultEntry& entry(std::size_t age) const {
    return entries_[next_ > age ? next_ - 1 - age : next_ + Length - 1 - age];
  }

 private:
  std::array<FaultEntry, Length> entries_{};
  std::size_t next_ = 0;
  std::uint32_t count_ = 0;
};

}  // namespace sonoglide::app
