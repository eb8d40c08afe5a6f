/// A record of each step around an event, at full rate, for a host that reads it afterwards.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "firmware/link/trace_messages.hpp"
#include "hal/board.hpp"

namespace sonoglide::app {

/// In the place of a trace, and costs nothing.
struct NoTrace {
  static constexpr std::size_t records = 0;

  template <class SupervisorT>
  static void record(const SupervisorT& /*supervisor*/) {}
  static void expect_target(std::uint32_t /*target*/) {}
  static void take_target() {}
  static void note_target(std::uint32_t /*period*/) {}
};

/// The control side writes records into a ring while an order of the service asks for it, and hands the
/// ring over when it is full. From then on until its next order the service reads; so no record is written
/// and read at the same moment, and neither side waits. What passes between them is two words: the order and
/// where its trace stands.
///
/// A trace whose order is done costs a step a comparison.
///
/// @tparam Records  2 ... 65535
/// @tparam DriveT   what the board is told: its bias or frequency is recorded too
/// @tparam Atomic   see CommandedSupervisor
template <std::size_t Records, class DriveT, template <class> class Atomic>
class Trace {
  static_assert(2 <= Records && Records <= UINT16_MAX);

 public:
  static constexpr std::size_t records = Records;

  /// Where it stands. The last two are of one that is whole.
  struct State {
    link::TracePhase phase;
    std::uint8_t cause;          ///< bits of link::Trigger
    std::uint16_t before;        ///< records before the trigger
    std::uint32_t first_period;  ///< of the oldest record
  };

  // ---- The control side's ----

  /// A step that is done, with its faults.
  template <class SupervisorT>
  void record(const SupervisorT& supervisor) {
    if (order_.load(std::memory_order_relaxed) != done_) {
      keep(supervisor);
    }
  }

  /// The target that was expected is in force.
  void take_target() { target_ = expected_target_; }

  /// A host's new target is answered for the first time in that period.
  void note_target(std::uint32_t period) { target_period_ = period; }

  // ---- The service's ----

  /// The target of the next order; none is pending.
  void expect_target(std::uint32_t target) { expected_target_ = target; }

  /// @param triggers  bits of link::Trigger
  /// @param before    below Records
  void arm(std::uint8_t triggers, std::uint16_t before) {
    // Told apart by their number, which is never that of no order.
    number_ = number_ % 255 + 1;
    order_.store(number_ << number_bit | std::uint32_t{triggers} << triggers_bit | before,
                 std::memory_order_release);
  }

  State state() const {
    const std::uint32_t shown = shown_.load(std::memory_order_acquire);
    const auto cause = static_cast<std::uint8_t>(shown >> triggers_bit & link::all_triggers);
    if (number_ == 0) {
      return {link::TracePhase::empty, 0, 0, 0};
    }
    if (shown >> number_bit != number_ || cause == 0) {
      return {link::TracePhase::waiting, 0, 0, 0};
    }
    const auto before = static_cast<std::uint16_t>(shown);
    return (shown & whole) == 0 ? State{link::TracePhase::recording, cause, before, 0}
                                : State{link::TracePhase::whole, cause, before, first_period_};
  }

  /// @param index  below Records, 0 is the oldest; of a trace that is whole
  link::TraceRecord read(std::uint16_t index) const {
    const Record& record = records_[(next_ + index) % Records];
    std::int32_t other = 0;
    if constexpr (extra != link::TraceExtra::none) {
      other = record.other;
    }
    return {index,
            record.friction_force,
            record.sliding_velocity,
            record.amplitude,
            record.target,
            record.codes,
            other};
  }

  static constexpr link::TraceExtra extra =
      std::is_same_v<DriveT, hal::BiasedDrive>     ? link::TraceExtra::bias
      : std::is_same_v<DriveT, hal::ResonantDrive> ? link::TraceExtra::frequency
                                                   : link::TraceExtra::none;

 private:
  // Of an order and of what is shown of it: its number, bits of link::Trigger, records before the trigger.
  static constexpr unsigned number_bit = 24;
  static constexpr unsigned triggers_bit = 16;
  static constexpr std::uint32_t whole = UINT32_C(1) << 23;

  struct Step {
    std::int32_t friction_force;
    std::int32_t sliding_velocity;
    std::int32_t amplitude;
    std::uint32_t target;
    std::uint32_t codes;
  };
  struct LongStep : Step {
    std::int32_t other;
  };
  using Record = std::conditional_t<extra == link::TraceExtra::none, Step, LongStep>;

  // Out of line, so that a step which nobody records is short.
  template <class SupervisorT>
  [[gnu::noinline]] void keep(const SupervisorT& supervisor) {
    const std::uint32_t order = order_.load(std::memory_order_acquire);
    if (order != taken_) {
      take(order);
    }
    write(records_[next_], supervisor);
    next_ = next_ + 1 < Records ? next_ + 1 : 0;
    if (left_ != 0) {
      --left_;
    } else if (const std::uint32_t cause = events(supervisor) & order >> triggers_bit) {
      left_ = static_cast<std::uint32_t>(Records - before_ - 1);
      cause_ = cause;
      first_period_ = supervisor.periods() - before_;
      show(0);
    } else {
      before_ += before_ < static_cast<std::uint16_t>(order) ? 1U : 0U;
      return;
    }
    if (left_ == 0) {
      done_ = order;
      show(whole);
    }
  }

  void take(std::uint32_t order) {
    taken_ = order;
    done_ = 0;  // no order: of an older one the number may come again
    before_ = 0;
    left_ = 0;
    cause_ = 0;
    show(0);
  }

  template <class SupervisorT>
  void write(Record& record, const SupervisorT& supervisor) const {
    const DriveT& drive = supervisor.drive();
    record.friction_force = supervisor.friction_force();
    record.sliding_velocity = supervisor.sliding_velocity();
    record.amplitude = drive.amplitude;
    record.target = target_;
    record.codes = codes_of(drive);
    if constexpr (extra == link::TraceExtra::bias) {
      record.other = drive.bias;
    } else if constexpr (extra == link::TraceExtra::frequency) {
      record.other = drive.frequency;
    }
  }

  /// What happened in this period, bits of link::Trigger.
  template <class SupervisorT>
  std::uint32_t events(const SupervisorT& supervisor) const {
    std::uint32_t events = static_cast<std::uint32_t>(link::Trigger::now);
    if (target_period_ == supervisor.periods()) {
      events |= static_cast<std::uint32_t>(link::Trigger::target);
    }
    if (supervisor.drive().fault != 0 &&
        supervisor.faults().entry(0).period == supervisor.periods()) {
      events |= static_cast<std::uint32_t>(link::Trigger::fault);
    }
    return events;
  }

  void show(std::uint32_t flags) {
    shown_.store((taken_ & UINT32_C(0xFF) << number_bit) | flags | cause_ << triggers_bit | before_,
                 std::memory_order_release);
  }

  Atomic<std::uint32_t> order_{0};
  Atomic<std::uint32_t> shown_{0};
  std::uint32_t number_ = 0;           ///< of the last order; of the service alone
  std::uint32_t expected_target_ = 0;  ///< likewise, but while an order is pending
  // Of the control side alone, but for what state() and read() take of a whole trace.
  std::uint32_t done_ = 0;   ///< the order that it has done
  std::uint32_t taken_ = 0;  ///< the order that it works on
  std::uint32_t target_ = 0;
  std::uint32_t target_period_ = 0;
  std::uint32_t cause_ = 0;
  std::uint32_t first_period_ = 0;
  std::uint32_t before_ = 0;  ///< records before the trigger
  std::uint32_t left_ = 0;    ///< records to come after the trigger; 0: it has not come
  std::size_t next_ = 0;      ///< of the ring; of a whole trace the oldest
  std::array<Record, Records> records_{};
};

}  // namespace sonoglide::app
