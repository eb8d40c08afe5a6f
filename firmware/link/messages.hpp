/// The messages between a unit and its host: requests, and for each an answer or a refusal.
///
/// Ratios, amplitudes
/// and parameters with six decimal places travel in millionths; force and speed as converter codes
/// (hal::Sample).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/link/payload.hpp"
#include "firmware/link/scale_messages.hpp"
#include "firmware/link/stream_messages.hpp"
#include "firmware/link/trace_messages.hpp"

namespace sonoglide::link {

/// Asks for Telemetry.
struct ReadTelemetry {
  static constexpr std::uint8_t kind = 0x01;

  template <class Message, class Visitor>
  static constexpr void fields(Message& /*message*/, Visitor&& /*visit*/) {}
};

/// What the unit measures and does in the present carrier period.
struct Telemetry {
  static constexpr std::uint8_t kind = ReadTelemetry::kind | answer_bit;
  std::uint32_t period;           ///< carrier periods served since reset, wraps
  std::int32_t friction_force;    ///< converter code
  std::int32_t sliding_velocity;  ///< converter code
  std::int32_t amplitude;         ///< code in force; full scale: the actuator's limit
  std::uint32_t target;           ///< app::Parameter::target, millionths
  std::uint8_t state;             ///< control::State
  std::uint8_t limit;             ///< control::Limit
  std::uint8_t fault;             ///< control::Fault or app::UnitFault
  std::uint8_t parameters;        ///< store::Origin
  std::uint16_t lost_frames;      ///< damaged, or one too many at a time; since reset, wraps
  std::uint8_t settling;          ///< control::Settling
  std::uint16_t mismatch;         ///< nominal over true friction, thousandths; 0: not known

  template <class Message, class Visitor>
  static constexpr void fields(Message& message, Visitor&& visit) {
    visit(message.period);
    visit(message.friction_force);
    visit(message.sliding_velocity);
    visit(message.amplitude);
    visit(message.target);
    visit(message.state);
    visit(message.limit);
    visit(message.fault);
    visit(message.parameters);
    visit(message.lost_frames);
    visit(message.settling);
    visit(message.mismatch);
  }
};

/// In force from the next carrier period on, until reset.
struct SetTarget {
  static constexpr std::uint8_t kind = 0x02;
  std::uint32_t target;  ///< app::Parameter::target, millionths

  template <class Message, class Visitor>
  static constexpr void fields(Message& message, Visitor&& visit) {
    visit(message.target);
  }
};

/// Answers SetTarget.
struct TargetSet : SetTarget {
  static constexpr std::uint8_t kind = SetTarget::kind | answer_bit;
};

/// Asks for ParameterValue.
struct ReadParameter {
  static constexpr std::uint8_t kind = 0x03;
  std::uint8_t parameter;  ///< app::Parameter

  template <class Message, class Visitor>
  static constexpr void fields(Message& message, Visitor&& visit) {
    visit(message.parameter);
  }
};

/// A parameter with its range; all numbers in units of the last decimal place.
struct ParameterValue {
  static constexpr std::uint8_t kind = ReadParameter::kind | answer_bit;
  std::uint8_t parameter;
  std::uint8_t decimal_places;  ///< of the four numbers that follow
  std::uint32_t value;
  std::uint32_t lowest;
  std::uint32_t highest;
  std::uint32_t preset;  ///< compiled in

  template <class Message, class Visitor>
  static constexpr void fields(Message& message, Visitor&& visit) {
    visit(message.parameter);
    visit(message.decimal_places);
    visit(message.value);
    visit(message.lowest);
    visit(message.highest);
    visit(message.preset);
  }
};

/// Needs the drive stopped. Answered when the value is safe in the store.
struct WriteParameter {
  static constexpr std::uint8_t kind = 0x04;
  std::uint8_t parameter;
  std::uint32_t value;

  template <class Message, class Visitor>
  static constexpr void fields(Message& message, Visitor&& visit) {
    visit(message.parameter);
    visit(message.value);
  }
};

/// Answers WriteParameter.
struct ParameterWritten : WriteParameter {
  static constexpr std::uint8_t kind = WriteParameter::kind | answer_bit;
};

/// The drive begins afresh, from a stop, from a fault or from running. Refused while parameters
/// that were lost, or set under another design, are not confirmed, and after a self test that failed.
struct Restart {
  static constexpr std::uint8_t kind = 0x05;

  template <class Message, class Visitor>
  static constexpr void fields(Message& /*message*/, Visitor&& /*visit*/) {}
};

/// Answers Restart.
struct Restarted : Restart {
  static constexpr std::uint8_t kind = Restart::kind | answer_bit;
};

/// Drive to zero until a restart, in the carrier period after the last byte of the stop. It does
/// not matter what is being answered or saved, nor which sequence number it has. Requests that came
/// before it and wait are refused as out of turn.
struct Stop {
  static constexpr std::uint8_t kind = 0x06;

  template <class Message, class Visitor>
  static constexpr void fields(Message& /*message*/, Visitor&& /*visit*/) {}
};

/// Answers Stop.
struct Stopped : Stop {
  static constexpr std::uint8_t kind = Stop::kind | answer_bit;
};

/// Asks for LoggedFault.
struct ReadFault {
  static constexpr std::uint8_t kind = 0x07;
  std::uint8_t age;  ///< 0: the latest

  template <class Message, class Visitor>
  static constexpr void fields(Message& message, Visitor&& visit) {
    visit(message.age);
  }
};

/// An entry of the log of faults.
struct LoggedFault {
  static constexpr std::uint8_t kind = ReadFault::kind | answer_bit;
  std::uint8_t age;
  std::uint8_t fault;    ///< control::Fault or app::UnitFault
  std::uint32_t period;  ///< in which it was found; wraps
  std::uint32_t count;   ///< faults since reset, those no longer kept included

  template <class Message, class Visitor>
  static constexpr void fields(Message& message, Visitor&& visit) {
    visit(message.age);
    visit(message.fault);
    visit(message.period);
    visit(message.count);
  }
};

/// Says that the parameters in force are right, so that a restart is allowed. Needs the drive
/// stopped. Answered when they are safe in the store. If it is refused as not saved, they are
/// confirmed until reset.
struct Confirm {
  static constexpr std::uint8_t kind = 0x08;

  template <class Message, class Visitor>
  static constexpr void fields(Message& /*message*/, Visitor&& /*visit*/) {}
};

/// Answers Confirm.
struct Confirmed : Confirm {
  static constexpr std::uint8_t kind = Confirm::kind | answer_bit;
};

/// A host begins a session: the number of its frame, whatever it is, is in turn, and no answer to a host
/// before it comes again.
struct Hello {
  static constexpr std::uint8_t kind = 0x09;
  std::uint16_t session;  ///< at random, so that a host knows the answer to its own hello

  template <class Message, class Visitor>
  static constexpr void fields(Message& message, Visitor&& visit) {
    visit(message.session);
  }
};

/// Answers Hello.
struct Greeted {
  static constexpr std::uint8_t kind = Hello::kind | answer_bit;
  std::uint16_t session;  ///< that of the hello
  std::uint32_t design;   ///< number of the unit's design, see app::FieldDesign

  template <class Message, class Visitor>
  static constexpr void fields(Message& message, Visitor&& visit) {
    visit(message.session);
    visit(message.design);
  }
};

/// Asks for Identity.
struct ReadIdentity {
  static constexpr std::uint8_t kind = 0x0A;

  template <class Message, class Visitor>
  static constexpr void fields(Message& /*message*/, Visitor&& /*visit*/) {}
};

inline constexpr std::size_t most_name_characters = 16;

/// What a unit is.
struct Identity {
  static constexpr std::uint8_t kind = ReadIdentity::kind | answer_bit;
  std::uint8_t major_number;  ///< of the firmware's version, as the two that follow
  std::uint8_t minor_number;
  std::uint8_t patch_number;
  std::uint32_t design;                          ///< see Greeted
  std::uint32_t serial_number;                   ///< 0: none was given
  std::array<char, most_name_characters> board;  ///< its name, with zeros behind it

  template <class Message, class Visitor>
  static constexpr void fields(Message& message, Visitor&& visit) {
    visit(message.major_number);
    visit(message.minor_number);
    visit(message.patch_number);
    visit(message.design);
    visit(message.serial_number);
    for (auto& character : message.board) {
      visit(character);
    }
  }
};

/// Asks for KeptException.
struct ReadException {
  static constexpr std::uint8_t kind = 0x10;

  template <class Message, class Visitor>
  static constexpr void fields(Message& /*message*/, Visitor&& /*visit*/) {}
};

/// The exception of the processor that ended the run before the reset; of a unit with a
/// history the last one, see History::exception_boot.
struct KeptException {
  static constexpr std::uint8_t kind = ReadException::kind | answer_bit;
  std::array<std::uint32_t, 7> words;  ///< hal::words_of

  template <class Message, class Visitor>
  static constexpr void fields(Message& message, Visitor&& visit) {
    for (auto& word : message.words) {
      visit(word);
    }
  }
};

/// Asks for History.
struct ReadHistory {
  static constexpr std::uint8_t kind = 0x11;

  template <class Message, class Visitor>
  static constexpr void fields(Message& /*message*/, Visitor&& /*visit*/) {}
};

/// What a unit has been through, see app::UnitHistory.
struct History {
  static constexpr std::uint8_t kind = ReadHistory::kind | answer_bit;
  std::uint32_t boots;
  std::uint32_t seconds;
  std::uint32_t watchdog_resets;
  std::uint32_t exceptions;
  std::uint32_t exception_boot;
  std::uint8_t cause;       ///< hal::ResetCause of the last reset
  std::uint8_t saved;       ///< 1: written down
  std::uint8_t began_anew;  ///< 1: the history before it could not be read

  template <class Message, class Visitor>
  static constexpr void fields(Message& message, Visitor&& visit) {
    visit(message.boots);
    visit(message.seconds);
    visit(message.watchdog_resets);
    visit(message.exceptions);
    visit(message.exception_boot);
    visit(message.cause);
    visit(message.saved);
    visit(message.began_anew);
  }
};

/// Asks for what may have changed since, and changes nothing: to be answered anew each time.
constexpr bool is_reading(std::uint8_t kind) {
  return kind == ReadTelemetry::kind || kind == ReadParameter::kind || kind == ReadFault::kind ||
         kind == ReadIdentity::kind || kind == ReadTraceState::kind ||
         kind == ReadTraceRecord::kind || kind == ReadScale::kind || kind == ReadException::kind ||
         kind == ReadHistory::kind;
}

enum class Reason : std::uint8_t {
  unknown_request = 1,
  wrong_length,
  out_of_range,       ///< lowest and highest name what is allowed
  unknown_parameter,  ///< of lowest … highest
  no_such_fault,      ///< that many are kept: highest; of exceptions none
  drive_not_stopped,
  not_saved,    ///< the store could not be written; the old value stands
  out_of_turn,  ///< an older frame than the last, whose sequence number is in lowest and highest
  parameters_not_confirmed,  ///< confirm them, or write one
  overtaken_by_fault,        ///< a fault came after the first byte of the request
  no_such_record,            ///< that many are there: highest; none before a trace is whole
  self_test_failed,          ///< until a reset at which the unit passes it
  tripped,                   ///< the board's hardware holds the drive off
};

/// Why a request was not carried out, with what would have been allowed.
struct Refusal {
  static constexpr std::uint8_t kind = 0xFF;
  std::uint8_t request;  ///< kind of what is refused
  std::uint8_t reason;   ///< Reason
  std::uint32_t lowest;
  std::uint32_t highest;

  template <class Message, class Visitor>
  static constexpr void fields(Message& message, Visitor&& visit) {
    visit(message.request);
    visit(message.reason);
    visit(message.lowest);
    visit(message.highest);
  }
};

}  // namespace sonoglide::link
