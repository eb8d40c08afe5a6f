/// What the processor was at when an exception ended the image, kept over the reset that follows.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>

namespace sonoglide::hal {

/// Of the first exception since the last one was taken. Of a Cortex-M0 and M0+ the three fault words are 0:
/// there are no such registers.
struct KeptException {
  std::uint32_t exception;        ///< its number, as in IPSR: 3 is the hard fault; RISC-V: mcause
  std::uint32_t program_counter;  ///< of the instruction that was interrupted; 0: no stack held it
  std::uint32_t link_register;    ///< where its function would have returned to; 0: likewise
  std::uint32_t program_status;   ///< xPSR; 0: likewise; RISC-V: mstatus
  std::uint32_t fault_status;     ///< CFSR, what went wrong; RISC-V: 0
  std::uint32_t hard_fault_status;  ///< HFSR; RISC-V: 0
  std::uint32_t fault_address;      ///< BFAR or MMFAR, 0 where neither is valid; RISC-V: mtval

  /// Calls visit(name, word) for each word, in the order in which they are stored and sent.
  template <class Record, class Visitor>
  static constexpr void visit_words(Record& record, Visitor&& visit) {
    visit("exception", record.exception);
    visit("program_counter", record.program_counter);
    visit("link_register", record.link_register);
    visit("program_status", record.program_status);
    visit("fault_status", record.fault_status);
    visit("hard_fault_status", record.hard_fault_status);
    visit("fault_address", record.fault_address);
  }
};

using ExceptionWords = std::array<std::uint32_t, sizeof(KeptException) / sizeof(std::uint32_t)>;

inline ExceptionWords words_of(const KeptException& exception) {
  ExceptionWords words{};
  std::memcpy(words.data(), &exception, sizeof words);
  return words;
}

inline KeptException exception_of(const ExceptionWords& words) {
  KeptException exception{};
  std::memcpy(&exception, words.data(), sizeof exception);
  return exception;
}

/// An image that calls this first in its main keeps its exceptions (hal/exception): each one that it does not expect
/// calls shutdown() (hal/start/image_end.hpp), writes to .noinit, and goes on to take_exception(). An image that
/// does not call it has none of this.
/// @return the one that was kept before, until the next reset, at which it is gone; null: none was
const KeptException* take_kept_exception();

}  // namespace sonoglide::hal
