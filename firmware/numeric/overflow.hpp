/// What fixed-point arithmetic does when a result leaves its range: policies as type tags.
///
/// Under every policy the result is the nearest end of the range. The policies differ in what else
/// an overflow does.
#pragma once

#include "firmware/numeric/signal_ledger.hpp"

namespace sonoglide::numeric {

/// For the image: clamps, and costs nothing more.
struct Saturating {
  static constexpr void on_overflow() {}
};

/// For simulation: the same values as Saturating, and the attached SignalLedger counts each clamp.
struct Counting {
  static void on_overflow() {
    if (attached_ledger != nullptr) {
      ++attached_ledger->pending_saturations;
    }
  }
};

/// For tests: the program stops where the first overflow happens.
struct Trapping {
  [[noreturn]] static void on_overflow() { __builtin_trap(); }
};

}  // namespace sonoglide::numeric
