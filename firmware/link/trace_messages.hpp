/// The messages of a trace: what a unit kept of a stretch of carrier periods, read after it is whole.
#pragma once

#include <cstdint>

#include "firmware/link/payload.hpp"

namespace sonoglide::link {

/// What a trace may wait for; a set of bits.
enum class Trigger : std::uint8_t {
  now = 1,     ///< the next step
  fault = 2,   ///< a fault comes
  target = 4,  ///< another target comes into force
};
inline constexpr std::uint8_t all_triggers = 7;

/// Where a trace stands.
enum class TracePhase : std::uint8_t {
  empty,      ///< since reset none was armed
  waiting,    ///< for what triggers it
  recording,  ///< what comes after that
  whole,      ///< may be read, until it is armed again
};

/// What a record has besides, in TraceRecord::other.
enum class TraceExtra : std::uint8_t {
  none,
  bias,       ///< code; full scale: drive.bias_limit_N
  frequency,  ///< steps of the frequency word above that of the start
};

/// Begins to record, in the place of any trace before.
struct ArmTrace {
  static constexpr std::uint8_t kind = 0x0C;
  std::uint8_t triggers;  ///< bits of Trigger, at least one
  std::uint16_t
      before;  ///< records to be kept of the steps before the trigger; fewer than there are

  template <class Message, class Visitor>
  static constexpr void fields(Message& message, Visitor&& visit) {
    visit(message.triggers);
    visit(message.before);
  }
};

/// Answers ArmTrace.
struct TraceArmed : ArmTrace {
  static constexpr std::uint8_t kind = ArmTrace::kind | answer_bit;
};

/// Asks for TraceState.
struct ReadTraceState {
  static constexpr std::uint8_t kind = 0x0D;

  template <class Message, class Visitor>
  static constexpr void fields(Message& /*message*/, Visitor&& /*visit*/) {}
};

struct TraceState {
  static constexpr std::uint8_t kind = ReadTraceState::kind | answer_bit;
  std::uint8_t phase;     ///< TracePhase
  std::uint8_t extra;     ///< TraceExtra
  std::uint16_t records;  ///< of a whole trace
  std::uint8_t cause;     ///< bits of Trigger: of one that is recording or whole
  std::uint16_t before;   ///< records of the steps before the trigger, likewise
  std::uint32_t
      first_period;  ///< of record 0 of a whole trace, wraps; each record is of the next period

  template <class Message, class Visitor>
  static constexpr void fields(Message& message, Visitor&& visit) {
    visit(message.phase);
    visit(message.extra);
    visit(message.records);
    visit(message.cause);
    visit(message.before);
    visit(message.first_period);
  }
};

/// Asks for TraceRecord.
struct ReadTraceRecord {
  static constexpr std::uint8_t kind = 0x0E;
  std::uint16_t index;  ///< 0: the oldest

  template <class Message, class Visitor>
  static constexpr void fields(Message& message, Visitor&& visit) {
    visit(message.index);
  }
};

/// A step: its sample, and what was answered.
struct TraceRecord {
  static constexpr std::uint8_t kind = ReadTraceRecord::kind | answer_bit;
  std::uint16_t index;
  std::int32_t friction_force;    ///< converter code
  std::int32_t sliding_velocity;  ///< converter code
  std::int32_t amplitude;         ///< code; full scale: the actuator's limit
  std::uint32_t target;           ///< app::Parameter::target, millionths
  std::uint32_t codes;            ///< state, limit, fault and settling, from the lowest byte on
  std::int32_t other;             ///< see TraceExtra

  template <class Message, class Visitor>
  static constexpr void fields(Message& message, Visitor&& visit) {
    visit(message.index);
    visit(message.friction_force);
    visit(message.sliding_velocity);
    visit(message.amplitude);
    visit(message.target);
    visit(message.codes);
    visit(message.other);
  }
};

}  // namespace sonoglide::link
