/// What caused the last reset of a board.
#pragma once

#include <cstdint>
#include <type_traits>

#include "hal/kept_exception.hpp"

namespace sonoglide::hal {

enum class ResetCause : std::uint8_t {
  power_on,   ///< RAM had lost what it held; a short dip of the power may not show
  reset,      ///< by pin, debugger or program: RAM was kept
  watchdog,   ///< as the board's watchdog says, which some emulators do not
  exception,  ///< the processor's; whatever reset the board afterwards
  crystal,    ///< of the clock has failed, as a board says that watches it; likewise
};

/// Of hal/exception: a word in .noinit tells. To be called once after a reset.
bool ram_was_kept();

namespace detail {

template <class Watchdog, class = void>
inline constexpr bool watches_crystal = false;
template <class Watchdog>
inline constexpr bool watches_crystal<Watchdog, std::void_t<decltype(Watchdog::crystal_failed())>> =
    true;

}  // namespace detail

/// To be called once after a reset.
/// @param exception  that take_kept_exception() has found, or null
template <class Watchdog>
ResetCause reset_cause(const Watchdog& watchdog, const KeptException* exception) {
  const bool kept = ram_was_kept();
  if constexpr (detail::watches_crystal<Watchdog>) {
    if (Watchdog::crystal_failed()) {
      return ResetCause::crystal;
    }
  }
  if (exception != nullptr) {
    return ResetCause::exception;
  }
  if (watchdog.caused_reset()) {
    return ResetCause::watchdog;
  }
  return kept ? ResetCause::reset : ResetCause::power_on;
}

}  // namespace sonoglide::hal
