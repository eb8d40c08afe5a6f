/// What a unit has been through, over all of its resets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "firmware/store/record_log.hpp"
#include "hal/board.hpp"
#include "hal/kept_exception.hpp"
#include "hal/reset_cause.hpp"

namespace sonoglide::app {

/// Counts resets and the time in operation, and keeps the last exception, in the third and fourth page of a flash.
///
/// A reset is written down when this is made, before the drive. The time is written down with it, and after a stop
/// if a minute has passed since: what a unit has run from its last stop until a reset is not counted.
template <class Flash>
class UnitHistory {
  static constexpr std::size_t exception_words = hal::ExceptionWords{}.size();
  using Log = store::RecordLog<Flash, 5 + exception_words>;

 public:
  using Pointer = UnitHistory*;
  static constexpr bool kept = true;

  /// Places of the record.
  enum Count : std::size_t {
    boots,            ///< resets, this one included
    seconds,          ///< in operation, as far as they are written down or passed since the reset
    watchdog_resets,  ///< of the boots
    exceptions,       ///< of the boots, those after an exception of the processor
    exception_boot,   ///< the number of the boot after the last of them
    last_exception,   ///< see hal::words_of
  };

  /// Waits until the boot is written down, or the flash has failed three times.
  /// @param flash               outlives this
  /// @param watchdog            fed meanwhile
  /// @param cause               of the last reset
  /// @param exception           before the reset; null: none
  /// @param periods_per_second  of the unit's loop, at least 1
  template <class Watchdog>
  [[gnu::cold, gnu::noinline]] UnitHistory(Flash& flash, Watchdog& watchdog, hal::ResetCause cause,
                                           const hal::KeptException* exception,
                                           std::uint32_t periods_per_second)
      : log_(flash, 2), cause_(cause), periods_per_second_(periods_per_second) {
    if (log_.load(record_) == store::Origin::damaged) {
      record_[boots] = began_anew_bit;
    }
    ++record_[boots];
    record_[watchdog_resets] += cause == hal::ResetCause::watchdog ? 1U : 0U;
    if (exception != nullptr) {
      ++record_[exceptions];
      record_[exception_boot] = (*this)[boots];
      note(*exception);
    }
    write_down(watchdog);
  }

  Pointer pointer() { return this; }

  hal::ResetCause cause() const { return cause_; }
  std::uint32_t operator[](Count place) const {
    return place == boots ? record_[boots] & ~began_anew_bit : record_[place];
  }
  /// Before the first boot of this history something stood in its pages that could not be read.
  bool began_anew() const { return (record_[boots] & began_anew_bit) != 0; }
  /// The last save that ended has succeeded, so that a reset finds the record.
  bool saved() const { return saved_; }

  /// Of the last boot after one; of no meaning before the first.
  hal::ExceptionWords exception() const {
    hal::ExceptionWords words{};
    for (std::size_t i = 0; i < exception_words; ++i) {
      words[i] = record_[last_exception + i];
    }
    return words;
  }

  /// Somebody asked for a stop.
  void note_stop() { stopped_ = true; }

  /// In each service.
  /// @param periods  of the loop since reset, wraps
  /// @param resting  the drive is zero, and nobody writes the flash
  [[gnu::cold, gnu::noinline]] void serve(std::uint32_t periods, bool resting) {
    if (periods - second_began_ >= periods_per_second_) {
      second_began_ += periods_per_second_;
      ++record_[seconds];
    }
    if (!resting) {
      return;
    }
    if (log_.saving()) {
      proceed();
    } else if (stopped_) {
      stopped_ = false;
      if (record_[seconds] - seconds_saved_ >= least_seconds) {
        save();
      }
    }
  }

 private:
  static constexpr std::uint32_t least_seconds = 60;         ///< from one save to the next
  static constexpr std::uint32_t began_anew_bit = 1U << 31;  ///< beside the boots

  void note(const hal::KeptException& exception) {
    const hal::ExceptionWords words = hal::words_of(exception);
    for (std::size_t i = 0; i < exception_words; ++i) {
      record_[last_exception + i] = words[i];
    }
  }

  [[gnu::cold, gnu::noinline]] void save() {
    log_.save(record_);
    seconds_saved_ = record_[seconds];
  }

  store::Saving proceed() {
    const store::Saving saving = log_.proceed();
    if (saving != store::Saving::busy) {
      saved_ = saving == store::Saving::saved;
    }
    return saving;
  }

  template <class Watchdog>
  void write_down(Watchdog& watchdog) {
    std::uint32_t polls = 1U << 22;  // some seconds
    for (int attempt = 0; attempt < 3 && !saved_ && polls > 0; ++attempt) {
      save();
      for (; proceed() == store::Saving::busy && polls > 0; --polls) {
        watchdog.feed();
      }
    }
  }

  Log log_;
  hal::ResetCause cause_;
  bool saved_ = false;
  bool stopped_ = false;
  std::uint32_t periods_per_second_;
  std::uint32_t second_began_ = 0;
  std::uint32_t seconds_saved_ = 0;
  typename Log::Record record_{};
};

/// Of a unit whose flash has no pages for one.
struct NoHistory {
  using Pointer = std::nullptr_t;
  static constexpr bool kept = false;

  template <class Flash, class Watchdog>
  NoHistory(Flash& /*flash*/, Watchdog& /*watchdog*/, hal::ResetCause /*cause*/,
            const hal::KeptException* /*exception*/, std::uint32_t /*periods_per_second*/) {}
  static Pointer pointer() { return nullptr; }
};

template <class Flash>
using HistoryOn = std::conditional_t<hal::keeps_history<Flash>, UnitHistory<Flash>, NoHistory>;

}  // namespace sonoglide::app
