/// Range and saturations of each fixed-point signal of a simulation.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace sonoglide::numeric {

struct Counting;

/// One named signal.
struct SignalRecord {
  const char* name = nullptr;
  std::uint64_t observations = 0;
  std::uint64_t saturations = 0;  ///< on the way to this signal since the observation before it
  double smallest = 0.0;
  double largest = 0.0;
};

/// Fixed capacity, no heap. The signals are in the order of their first observation.
struct SignalLedger {
  static constexpr std::size_t capacity = 32;

  std::array<SignalRecord, capacity> signals{};
  std::size_t size = 0;
  std::uint64_t pending_saturations = 0;    ///< counted, not yet attributed to a signal
  std::uint64_t unplaced_observations = 0;  ///< of signals that came after the ledger was full
  std::uint64_t unplaced_saturations = 0;   ///< attributed to such a signal

  /// Saturations of every signal together, those not yet attributed included.
  constexpr std::uint64_t total_saturations() const {
    std::uint64_t total = pending_saturations + unplaced_saturations;
    for (std::size_t i = 0; i < size; ++i) {
      total += signals[i].saturations;
    }
    return total;
  }

  /// Record of that name; null if it was never observed.
  constexpr const SignalRecord* find(const char* name) const {
    for (std::size_t i = 0; i < size; ++i) {
      if (same_name(signals[i].name, name)) {
        return &signals[i];
      }
    }
    return nullptr;
  }

  /// Enters one value, and every saturation since the entry before it.
  constexpr void record(const char* name, double value) {
    const std::uint64_t saturations = pending_saturations;
    pending_saturations = 0;
    SignalRecord* signal = find_or_open(name, value);
    if (signal == nullptr) {
      ++unplaced_observations;
      unplaced_saturations += saturations;
      return;
    }
    ++signal->observations;
    signal->saturations += saturations;
    signal->smallest = value < signal->smallest ? value : signal->smallest;
    signal->largest = value > signal->largest ? value : signal->largest;
  }

 private:
  static constexpr bool same_name(const char* a, const char* b) {
    if (a == b) {
      return true;
    }
    for (; *a == *b; ++a, ++b) {
      if (*a == '\0') {
        return true;
      }
    }
    return false;
  }

  constexpr SignalRecord* find_or_open(const char* name, double value) {
    for (std::size_t i = 0; i < size; ++i) {
      if (same_name(signals[i].name, name)) {
        return &signals[i];
      }
    }
    if (size == capacity) {
      return nullptr;
    }
    SignalRecord& opened = signals[size++];
    opened.name = name;
    opened.smallest = value;
    opened.largest = value;
    return &opened;
  }
};

/// The ledger that Counting arithmetic of this thread writes to; if it is null, nothing is
/// recorded. Other policies never name it, so an image holds no trace of it.
inline thread_local SignalLedger* attached_ledger = nullptr;

/// Attaches a ledger to this thread. The end of the scope restores the previous one.
class LedgerScope {
 public:
  explicit LedgerScope(SignalLedger& ledger) : previous_(attached_ledger) {
    attached_ledger = &ledger;
  }
  ~LedgerScope() { attached_ledger = previous_; }
  LedgerScope(const LedgerScope&) = delete;
  LedgerScope& operator=(const LedgerScope&) = delete;

 private:
  SignalLedger* previous_;
};

/// Whether a scalar counts its saturations.
template <class Scalar, class = void>
struct IsCounted : std::false_type {};
template <class Scalar>
struct IsCounted<Scalar, std::void_t<typename Scalar::Overflow>>
    : std::is_same<typename Scalar::Overflow, Counting> {};

/// Returns value unchanged; under Counting also enters it in the attached ledger.
///
/// @tparam Signal  names the signal: `static constexpr const char* name`. Every saturation since
///                 the previous observation is charged to it.
/// For every other scalar this is the identity: no code, no string.
template <class Signal, class Scalar>
constexpr Scalar observe(Scalar value) {
  if constexpr (IsCounted<Scalar>::value) {
    if (attached_ledger != nullptr) {
      attached_ledger->record(Signal::name, value.to_real());
    }
  }
  return value;
}

}  // namespace sonoglide::numeric
