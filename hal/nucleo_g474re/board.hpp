/// Nucleo-G474RE: the carrier and the sample of each of its periods, and what a unit needs besides.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/board.hpp"
#include "hal/bridge.hpp"
#include "hal/lockstep/board/lockstep_board.hpp"
#include "hal/lockstep/board/serial_link.hpp"
#include "hal/nucleo_g474re/clocks.hpp"
#include "hal/nucleo_g474re/control_registers.hpp"
#include "hal/nucleo_g474re/demodulation.hpp"
#include "hal/nucleo_g474re/encoder.hpp"

namespace sonoglide::hal::nucleo_g474re {

/// Source: ST, RM0440, ADC registers.
struct ConverterRegisters {
  volatile std::uint32_t status;
  volatile std::uint32_t interrupting;
  volatile std::uint32_t control;
  volatile std::uint32_t configuration;
  volatile std::uint32_t configuration_2;
  volatile std::uint32_t sampling_times[2];
  std::uint32_t reserved_0;
  volatile std::uint32_t thresholds[3];
  std::uint32_t reserved_1;
  volatile std::uint32_t sequence[4];
  volatile std::uint32_t result;
};

struct TransferEvents {
  volatile std::uint32_t raw;
  volatile std::uint32_t clear;
};

struct WatchdogRegisters {
  volatile std::uint32_t control;
  volatile std::uint32_t window;
};

// Addresses from memory.ld.
extern "C" {
extern TransferEvents transfer_events;
extern ConverterRegisters force_converter;
extern ConverterRegisters velocity_converter;
extern ConverterRegisters vibration_converter;
extern WatchdogRegisters watchdog;
}

/// What the DMA carries: two blocks in turn, of a carrier period each.
extern "C" {
extern std::uint32_t pairs[2][conversions_in_period];  ///< velocity above force
extern std::uint16_t vibration[2][conversions_in_period];
}

/// Calls take_carrier (defined by the image) in the interrupt that begins a carrier period.
extern "C" void take_carrier();

/// The carrier: a full bridge at PA8 and PA10, driven by pulses that are centred on the drive's phases 0 and pi
/// (hal/bridge.hpp); a negative amplitude exchanges the two. The sample of a period is the mean of 16
/// conversions of each value at even distances, begun by a timer that each carrier period sets back: of the force
/// (PA0), the sliding velocity (PA1) and the vibration velocity (PB0). The DMA carries them to RAM, in two blocks,
/// so that they stay there for a period. A converter tells by itself of a conversion at an end of its range.
///
/// While PA6 is low, or after the chip found a fault of its own, both legs are low and no sample is fresh, and
/// tripped() says so. The legs may be driven again once the controller has answered with an amplitude of 0.
class Board {
 public:
  static constexpr bool computes_floating_point = true;
  static constexpr bool observes_vibration = true;
  static constexpr bool has_vibration_sensor = true;
  static constexpr std::uint32_t clock_hz = system_hz;

  /// Clocks in a carrier period; 0 if the board cannot make it: the frequency is 84 MHz / n, n from 960 to 65,535.
  static constexpr std::uint32_t period_ticks(double period_s) {
    const std::uint32_t ticks = nearest_period_ticks(period_s);
    return is_period(ticks, system_hz, period_s) ? ticks : 0;
  }

  /// Likewise at the start of a drive that is tuned, whose frequency need not be one of these.
  static constexpr std::uint32_t nearest_period_ticks(double period_s) {
    // Not negative. NOLINTNEXTLINE(bugprone-incorrect-roundings)
    const auto half = static_cast<std::uint32_t>(period_s * 0.5 * system_hz + 0.5);
    return 960 <= half && half <= 0xffff ? 2 * half : 0;
  }

  /// Starts the conversions, and the carrier with both legs low.
  explicit Board(std::uint32_t period_ticks);

  /// For answers with a frequency: a period may then be a fraction of two clocks longer or shorter, which the
  /// next one takes into account.
  /// @param period_s           of the carrier at the start
  /// @param frequency_step_Hz  of an answer
  void tune(double period_s, double frequency_step_Hz) {
    half_of_start_ = static_cast<float>(period_s * 0.5 * system_hz);
    step_ = static_cast<float>(frequency_step_Hz * period_s);
  }

  /// Lets each carrier period call take_carrier.
  static void interrupt();

  /// A period whose conversions are not all there is not fresh, nor is one of a bridge that is held off.
  bool sample(Sample& sample) {
    constexpr std::uint32_t blocks_of_pairs[2] = {1U << 2, 1U << 1};
    begin(0xf, blocks_of_pairs[block_]);
    take(sample);
    return true;
  }

  bool sample(VibrationSample& sample) {
    constexpr std::uint32_t blocks_of_both[2] = {1U << 2 | 1U << 6, 1U << 1 | 1U << 5};
    begin(0xff, blocks_of_both[block_]);
    const std::size_t block = take(sample);
    const Phasor phasor = demodulated(vibration[block]);
    sample.in_phase = phasor.in_phase;
    sample.quadrature = phasor.quadrature;
    sample.vibration_at_rail = at_rail(vibration_converter);
    sample.vibration_fresh = sample.fresh;
    return true;
  }

  void drive(const Drive& drive) { put(drive.amplitude, half_period_); }

  /// Amplitude and period are taken over together.
  void drive(const ResonantDrive& drive) {
    remainder_ += half_of_start_ / (1.0F + static_cast<float>(drive.frequency) * step_);
    half_period_ = static_cast<std::uint32_t>(remainder_);
    remainder_ -= static_cast<float>(half_period_);
    carrier_timer.reload = half_period_;
    sampling_timer.reload = clocks_between_conversions(half_period_) - 1;
    put(drive.amplitude, half_period_);
  }

  /// Since it was asked last, or still: 1 the line at PA6, 2 a fault of the chip, which lasts until a reset.
  static std::uint8_t tripped() {
    const std::uint32_t causes = carrier_timer.status & (broken_by_line | broken_by_chip);
    if (causes == 0) {
      return 0;
    }
    carrier_timer.status = ~causes;
    return (causes & broken_by_chip) != 0 ? 2 : 1;
  }

  std::uint32_t period() const {
    return period_ + ((carrier_timer.status & update_event) != 0 ? 1U : 0U);
  }

 private:
  /// Waits for the end of a carrier period.
  /// @param events   that the transfers of a sample have
  /// @param awaited  those of the block that ends
  void begin(std::uint32_t events, std::uint32_t awaited) {
    while ((carrier_timer.status & update_event) == 0) {
    }
    carrier_timer.status = ~update_event;
    ++period_;
    const std::uint32_t ended = transfer_events.raw & events & ~event_of_any;
    transfer_events.clear = ended;
    whole_ = ended == awaited;
    asm volatile("" : : : "memory");  // the blocks are read from here on
  }

  /// @return the block that has ended
  std::size_t take(Sample& sample) {
    const std::size_t block = block_;
    block_ ^= whole_ ? 1U : 0U;
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < conversions_in_period; ++i) {
      sum += pairs[block][i];
    }
    sample.friction_force = left_justified(sum & 0xffffU);
    sample.sliding_velocity = left_justified(sum >> 16);
    sample.force_at_rail = at_rail(force_converter);
    sample.velocity_at_rail = at_rail(velocity_converter);
    sample.fresh = whole_ && (carrier_timer.break_control & drives) != 0;
    return block;
  }

  /// 16 codes of 12 bits, offset binary, as a code whose full scale is 2^31.
  static std::int32_t left_justified(std::uint32_t sum) {
    return static_cast<std::int32_t>((sum << 16) ^ 0x80000000U);
  }

  /// Since it was asked last.
  static bool at_rail(ConverterRegisters& converter) {
    constexpr std::uint32_t out_of_thresholds = 1U << 7;
    const bool left = (converter.status & out_of_thresholds) != 0;
    if (left) {
      converter.status = out_of_thresholds;
    }
    return left;
  }

  /// Each leg is high while the counter, which rises from 0 to half a period and falls again, is below its first
  /// compare value or not below its second one.
  static void put(std::int32_t amplitude, std::uint32_t half_period) {
    const auto code = static_cast<std::uint32_t>(amplitude);
    const std::uint32_t width = half_width_of(amplitude < 0 ? 0U - code : code, half_period);
    const std::uint32_t forward = amplitude < 0 ? 0 : width;
    const std::uint32_t backward = width - forward;
    carrier_timer.compare[0] = forward;
    carrier_timer.compare[1] = half_period - backward;
    carrier_timer.compare[2] = backward;
    carrier_timer.compare[3] = half_period - forward;
    if (amplitude == 0) {
      carrier_timer.break_control = outputs_on;
    }
  }

  static constexpr std::uint32_t clocks_between_conversions(std::uint32_t half_period) {
    constexpr std::uint32_t in_half_period = conversions_in_period / 2;
    return (half_period + in_half_period / 2) / in_half_period;
  }

  static constexpr std::uint32_t drives = 1U << 15;
  static constexpr std::uint32_t event_of_any = 1U << 0 | 1U << 4;

  std::uint32_t half_period_;  ///< clocks, in force from the next period on
  float half_of_start_;        ///< likewise, with their fraction
  float step_ = 0.0F;          ///< of the frequency, relative to that of the start
  float remainder_ = 0.0F;
  std::uint32_t period_ = 0;
  std::size_t block_ = 0;  ///< whose conversions end with the present period
  bool whole_ = false;
};

#ifdef SONOGLIDE_ENCODER_COUNTS_PER_M
/// With an encoder along the sliding, see encoder.hpp; the definition is its resolution.
class BoardWithEncoder : public Board {
 public:
  static constexpr double travel_counts_per_m = SONOGLIDE_ENCODER_COUNTS_PER_M;

  explicit BoardWithEncoder(std::uint32_t period_ticks) : Board(period_ticks) { start_encoder(); }

  static std::uint32_t travel() { return latched_count(); }
};
#endif

/// A byte link, see hal/board.hpp: USART2 at PA2 and PA3, which the debugger of the board shows as a serial port
/// on USB; 115200 baud, 8 data bits, no parity, one stop bit. 256 bytes wait in a ring that the DMA fills.
class Uart {
 public:
  Uart();
  bool receive(std::uint8_t& byte);
  bool send(std::uint8_t byte);

 private:
  std::size_t next_ = 0;
};

/// Resets the chip 0.1 s after it was last reloaded, or at once if it is reloaded within 50 ms of that.
class Watchdog {
 public:
  Watchdog();
  void feed() {
    if ((watchdog.control & count) <= latest) {
      watchdog.control = full;
    }
  }
  bool caused_reset() const { return caused_reset_; }
  /// Before the reset. It is asked once.
  static bool crystal_failed();

 private:
  static constexpr std::uint32_t count = 0x7f;
  static constexpr std::uint32_t full = 0xff;
  static constexpr std::uint32_t latest = 0x5f;  ///< count from which on it may be reloaded

  bool caused_reset_;
};

/// The last four pages of the second bank, the first two of them for the history; they may be erased and programmed
/// while the first bank is read. Each word takes 64 bits.
class Flash {
 public:
  static constexpr std::size_t page_words = 256;
  static constexpr std::size_t pages = 4;

  std::uint32_t read(std::size_t page, std::size_t word) const;
  void erase(std::size_t page);
  void program(std::size_t page, std::size_t word, std::uint32_t value);
  bool busy() const;
};

/// What a unit finds on a Nucleo-G474RE.
struct Hardware {
  static constexpr std::size_t trace_records = 1024;
  using Board = nucleo_g474re::Board;
#ifdef SONOGLIDE_ENCODER_COUNTS_PER_M
  using BoardWithEncoder = nucleo_g474re::BoardWithEncoder;
#endif
  using ByteLink = Uart;
  using Watchdog = nucleo_g474re::Watchdog;
  using Flash = nucleo_g474re::Flash;
};

/// In lockstep with a host at the serial line; the bridge stays off.
using SerialBoard = lockstep::LockstepBoard<lockstep::SerialLink<Uart>, lockstep::ProcessorCounter>;

}  // namespace sonoglide::hal::nucleo_g474re
