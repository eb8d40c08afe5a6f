/// Raspberry Pi Pico and Pico 2: the carrier and the sample of each of its periods, and what a unit needs besides.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hal/board.hpp"
#include "hal/bridge.hpp"
#include "hal/lockstep/board/lockstep_board.hpp"
#include "hal/lockstep/board/serial_link.hpp"
#include "hal/pico/chip.hpp"

namespace sonoglide::hal::pico {

/// Source: Raspberry Pi, RP2040 and RP2350 Datasheets, PWM.
struct SliceRegisters {
  volatile std::uint32_t control;
  volatile std::uint32_t divider;
  volatile std::uint32_t counter;
  volatile std::uint32_t compare;  ///< of A, and of B above; taken over where the counter is 0
  volatile std::uint32_t top;
};

/// Of the PWM, of the DMA: a bit for each slice or channel.
struct EventRegisters {
  volatile std::uint32_t raw;  ///< a set bit clears it
  volatile std::uint32_t interrupting;
};

// Addresses from memory.ld.
extern "C" {
extern SliceRegisters carrier_slice;    ///< slice 1: A is GPIO 2, B is GPIO 3
extern EventRegisters carrier_events;   ///< of all slices
extern EventRegisters transfer_events;  ///< of all channels
extern volatile std::uint32_t watchdog_load;
}

/// Force in the lower halves and velocity in the upper ones, as they were converted in a period.
inline constexpr std::size_t pairs_in_period = 4;
extern "C" volatile std::uint32_t conversions[2][pairs_in_period];

/// Calls take_carrier (defined by the image) in the interrupt that begins a carrier period.
extern "C" void take_carrier();

/// The carrier: a full bridge at GPIO 2 and 3, driven by pulses that are centred on the drive's phases 0
/// and pi (hal/bridge.hpp). The sample of a period is the mean of four conversions of the force (GPIO 26)
/// and of four of the sliding velocity (GPIO 27), taken in turn. Two channels of the DMA carry them to
/// RAM, one for the even and one for the odd periods, so that they stay there for a period.
class Board {
 public:
  static constexpr bool computes_floating_point = fast;
  static constexpr bool observes_vibration = fast;
  static constexpr bool has_vibration_sensor = false;
  static constexpr std::uint32_t clock_hz = system_hz;

  /// Clocks of the system in a carrier period; 0 if the board cannot make it. Eight conversions of a whole
  /// number of converter clocks each, of at least 97, fill a period: so the frequency is 6 MHz / n, n from
  /// 97 on, 60 kHz with n = 100.
  static constexpr std::uint32_t period_ticks(double period_s) {
    constexpr std::uint32_t step = system_hz / (converter_hz / (2 * pairs_in_period));
    // Not negative. NOLINTNEXTLINE(bugprone-incorrect-roundings)
    const auto steps = static_cast<std::uint32_t>(period_s * system_hz / step + 0.5);
    const std::uint32_t ticks = steps * step;
    const bool whole = is_period(ticks, system_hz, period_s) && ticks % 2 == 0;
    return whole && 97 <= steps && ticks / 2 <= 0xffff ? ticks : 0;
  }

  /// Starts the conversions, and the carrier at an end of a period's conversions.
  explicit Board(std::uint32_t period_ticks);

  /// Lets each carrier period call take_carrier.
  static void interrupt();

  /// A period whose conversions are not all there, or not all sound, is not fresh.
  bool sample(Sample& sample) {
    while ((carrier_events.raw & slice_event) == 0) {
    }
    carrier_events.raw = slice_event;
    ++period_;
    const std::uint32_t ended = transfer_events.raw & (1U << 0 | 1U << 1);
    transfer_events.raw = ended;
    const volatile std::uint32_t* const pairs = conversions[channel_];
    std::uint32_t sum = 0;
    std::uint32_t above =
        0;  // bits 12 and 28 where one is 4095, bits 15 and 31 where one has failed
    std::uint32_t below = ~0U;  // bits 15 and 31 unless one is 0
    for (std::size_t i = 0; i < pairs_in_period; ++i) {
      const std::uint32_t pair = pairs[i];
      sum += pair;
      above |= pair + 0x00010001U;
      below &= pair + 0x7fff7fffU;
    }
    const bool whole = ended == 1U << channel_;
    channel_ ^= whole ? 1U : 0U;
    sample.friction_force = left_justified(sum & 0xffffU);
    sample.sliding_velocity = left_justified(sum >> 16);
    sample.force_at_rail = (((above >> 12) | ~(below >> 15)) & 1U) != 0;
    sample.velocity_at_rail = (((above >> 28) | ~(below >> 31)) & 1U) != 0;
    sample.fresh = whole && (above & 0x80008000U) == 0;
    return true;
  }

  void drive(const Drive& drive) {
    carrier_slice.compare =
        pulses_of(half_width_of(static_cast<std::uint32_t>(drive.amplitude), half_period_));
  }

  std::uint32_t period() const {
    return period_ + ((carrier_events.raw & slice_event) != 0 ? 1U : 0U);
  }

 private:
  static constexpr std::uint32_t slice_event = 1U << 1;

  /// Compare values of both outputs. The slice counts from 0 to half a carrier period less one and down again:
  /// A is high within so many counts of 0, and B, which is inverted, within as many of the top.
  std::uint32_t pulses_of(std::uint32_t half_width) const {
    return half_width | (half_period_ - half_width) << 16;
  }

  /// Four codes of 12 bits, offset binary, as a code whose full scale is 2^31.
  static std::int32_t left_justified(std::uint32_t sum) {
    return static_cast<std::int32_t>((sum << 18) ^ 0x80000000U);
  }

  std::uint32_t half_period_;  ///< clocks of the system
  std::uint32_t period_ = 0;
  std::uint32_t channel_ = 0;  ///< whose conversions end with the present period
};

/// A byte link, see hal/board.hpp: UART0, transmits at GPIO 0 and receives at GPIO 1; 115200 baud, 8 data
/// bits, no parity, one stop bit; 32 bytes wait.
class Uart {
 public:
  static constexpr std::uint32_t baud = 115200;

  Uart();
  bool receive(std::uint8_t& byte);
  bool send(std::uint8_t byte);
};

/// Resets the chip, but for its oscillators, 0.1 s after it was last fed.
class Watchdog {
 public:
  Watchdog();
  void feed() { watchdog_load = tenth_of_a_second; }
  bool caused_reset() const { return caused_reset_; }

 private:
  static constexpr std::uint32_t tenth_of_a_second = watchdog_counts_in_us * 100000;

  bool caused_reset_;
};

/// The last four sectors of the flash, the first two of them for the history. Once this is made, the flash is no
/// longer in the address space: its chip is spoken to byte by byte.
class Flash {
 public:
  static constexpr std::size_t page_words = 64;
  static constexpr std::size_t pages = 4;

  Flash();
  std::uint32_t read(std::size_t page, std::size_t word) const;
  void erase(std::size_t page);
  void program(std::size_t page, std::size_t word, std::uint32_t value);
  bool busy() const;
};

/// What a unit finds on a Pico.
struct Hardware {
  /// Where a carrier period leaves time for it.
  static constexpr std::size_t trace_records = fast ? 1024 : 0;
  using Board = pico::Board;
  using ByteLink = Uart;
  using Watchdog = pico::Watchdog;
  using Flash = pico::Flash;
};

/// In lockstep with a host at the serial line; the bridge stays off.
using SerialBoard = lockstep::LockstepBoard<lockstep::SerialLink<Uart>, lockstep::ProcessorCounter>;

}  // namespace sonoglide::hal::pico
