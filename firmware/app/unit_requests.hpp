/// What a host asks of a unit, and what it is answered.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "firmware/app/identity.hpp"
#include "firmware/app/mismatch.hpp"
#include "firmware/app/telemetry_stream.hpp"
#include "firmware/app/unit.hpp"
#include "firmware/link/frame.hpp"
#include "firmware/link/messages.hpp"
#include "hal/kept_exception.hpp"

namespace sonoglide::app {

/// Carries out one request after the other. A restart, a new target and what is saved take some services
/// until they are answered.
///
/// @tparam Product  what the unit says of itself: see Unnamed.
template <class UnitT, class Product>
class UnitRequests {
 public:
  explicit UnitRequests(UnitT& unit) : unit_(unit) {}

  /// Begins with a request, while none is in hand.
  /// @param request  of any kind; what asks for nothing but words is answered whatever fault came
  /// @param faults   since reset, when its first byte came
  void take(const link::Frame& request, std::uint32_t faults) {
    sequence_ = request.sequence;
    faults_ = faults;
    answered_ = false;
    if (faults == unit_.supervisor().faults().count() || link::is_reading(request.kind) ||
        request.kind == link::Hello::kind) {
      dispatch(request);
    } else {
      refuse(request.kind, link::Reason::overtaken_by_fault);
    }
  }

  /// What is read, once more, while no request is in hand.
  void take_again(const link::Frame& request) {
    answered_ = false;
    dispatch(request);
  }

  /// A request is not yet answered.
  bool in_hand() const { return !answered_; }

  /// The next step of the request in hand.
  /// @param last  sequence number of the last stop
  void proceed(std::uint16_t last) {
    if (ordering_ != 0) {
      finish_order(unit_.order_end(), last);
    } else {
      finish_save(unit_.proceed());
    }
  }

  /// To the last request that was answered.
  const link::Frame& answer() const { return answer_; }

  void count_lost_frame() { ++lost_frames_; }

  void note_stop() {
    if constexpr (has_history) {
      Product::history->note_stop();
    }
  }

  /// In each service: the history of the unit takes its time, and a step of a save.
  void serve_history() {
    if constexpr (has_history) {
      const Snapshot shown = unit_.supervisor().snapshot();
      Product::history->serve(shown.periods, !in_hand() && !shown.driving());
    }
  }

  /// A sample of the stream.
  /// @param sample  where it goes
  /// @param free    the line is; else none is taken
  /// @return whether one was taken
  bool take_sample(link::Streamed& sample, bool free) {
    if (!stream_.running()) {
      return false;
    }
    const Snapshot shown = unit_.supervisor().snapshot();
    const bool taken = stream_.waits(shown.periods) && free;
    if (taken) {
      sample = stream_.take(shown, unit_.target());
    }
    return taken;
  }

 private:
  static constexpr bool has_history = !std::is_null_pointer_v<decltype(Product::history)>;
  static constexpr auto trace_records =
      static_cast<std::uint16_t>(UnitT::Supervisor::Recorder::records);

  [[gnu::cold]] void dispatch(const link::Frame& request) {
    if (request.kind == link::Stop::kind) {
      refuse(request.kind,
             link::Reason::wrong_length);  // one of the right length does not come here
      return;
    }
    const bool known = handles<link::ReadTelemetry>(request) || handles<link::SetTarget>(request) ||
                       handles<link::ReadParameter>(request) ||
                       handles<link::WriteParameter>(request) || handles<link::Restart>(request) ||
                       handles<link::ReadFault>(request) || handles<link::Confirm>(request) ||
                       handles<link::Hello>(request) || handles<link::ReadIdentity>(request) ||
                       handles<link::ReadScale>(request) || handles<link::Stream>(request) ||
                       handles_trace(request) || handles_exception(request) ||
                       handles_history(request);
    if (!known) {
      refuse(request.kind, link::Reason::unknown_request);
    }
  }

  bool handles_trace([[maybe_unused]] const link::Frame& request) {
    if constexpr (trace_records > 0) {
      return handles<link::ArmTrace>(request) || handles<link::ReadTraceState>(request) ||
             handles<link::ReadTraceRecord>(request);
    } else {
      return false;
    }
  }

  bool handles_exception([[maybe_unused]] const link::Frame& request) {
    if constexpr (!std::is_null_pointer_v<decltype(Product::exception)>) {
      return handles<link::ReadException>(request);
    } else {
      return false;
    }
  }

  bool handles_history([[maybe_unused]] const link::Frame& request) {
    if constexpr (has_history) {
      return handles<link::ReadHistory>(request);
    } else {
      return false;
    }
  }

  template <class Request>
  bool handles(const link::Frame& frame) {
    if (frame.kind != Request::kind) {
      return false;
    }
    Request request{};
    if (link::read(frame, request)) {
      carry_out(request);
    } else {
      refuse(frame.kind, link::Reason::wrong_length);
    }
    return true;
  }

  // ---- Requests ----

  void carry_out(const link::ReadTelemetry& /*request*/) {
    const Snapshot shown = unit_.supervisor().snapshot();
    const hal::Drive& drive = shown.drive;
    answer(link::Telemetry{shown.periods, shown.friction_force, shown.sliding_velocity,
                           drive.amplitude, unit_.target(), drive.state, drive.limit, drive.fault,
                           static_cast<std::uint8_t>(unit_.origin()), lost_frames_, drive.settling,
                           mismatch_thousandths(drive, unit_.target_ratio())});
  }

  void carry_out(const link::Hello& request) {
    stream_.end();
    answer(link::Greeted{request.session, unit_.design()});
  }

  void carry_out(const link::ReadIdentity& /*request*/) {
    constexpr auto board = padded<link::most_name_characters>(Product::board);
    answer(link::Identity{version.major_number, version.minor_number, version.patch_number,
                          unit_.design(), Product::serial_number(), board});
  }

  void carry_out(const link::ReadScale& request) {
    const link::FullScales& scales = unit_.full_scales();
    if (request.quantity < scales.size()) {
      answer(link::scale_of(request.quantity, scales[request.quantity]));
    } else {
      refuse(request.kind, link::Reason::out_of_range, 0, link::quantity_count - 1);
    }
  }

  void carry_out(const link::Stream& request) {
    if (request.channels > link::all_channels) {
      refuse(request.kind, link::Reason::out_of_range, 0, link::all_channels);
    } else if (request.every == 0) {
      refuse(request.kind, link::Reason::out_of_range, 1, UINT16_MAX);
    } else {
      stream_.begin(request, unit_.supervisor().snapshot().periods);
      link::Streaming streaming{};
      streaming.channels = request.channels;
      streaming.every = request.every;
      answer(streaming);
    }
  }

  void carry_out(const link::SetTarget& request) {
    if (unit_.set_target(request.target, faults_) == Answer::taken) {
      ordering_ = request.kind;
    } else {
      refuse_value(request.kind, unit_.range(Parameter::target));
    }
  }

  void carry_out(const link::ReadParameter& request) {
    if (request.parameter >= parameter_count) {
      refuse_parameter(request.kind);
      return;
    }
    const ParameterRange& range = unit_.range(request.parameter);
    answer(link::ParameterValue{
        request.parameter, parameter_labels[request.parameter].decimal_places,
        unit_.value(request.parameter), range.lowest, range.highest, range.preset});
  }

  void carry_out(const link::WriteParameter& request) {
    switch (unit_.write(request.parameter, request.value)) {
      case Answer::taken:
        writing_ = request;
        saving_ = request.kind;
        break;
      case Answer::out_of_range:
        refuse_value(request.kind, unit_.range(request.parameter));
        break;
      case Answer::unknown_parameter:
        refuse_parameter(request.kind);
        break;
      case Answer::drive_not_stopped:
      case Answer::parameters_not_confirmed:
      case Answer::self_test_failed:
        refuse(request.kind, link::Reason::drive_not_stopped);
        break;
    }
  }

  void carry_out(const link::Confirm& request) {
    if (unit_.confirm() == Answer::taken) {
      saving_ = request.kind;
    } else {
      refuse(request.kind, link::Reason::drive_not_stopped);
    }
  }

  void finish_save(store::Saving saving) {
    if (saving == store::Saving::busy) {
      return;
    }
    const std::uint8_t request = saving_;
    saving_ = 0;
    if (saving != store::Saving::saved) {
      refuse(request, link::Reason::not_saved);
    } else if (request == link::Confirm::kind) {
      answer(link::Confirmed{});
    } else {
      link::ParameterWritten written{};
      written.parameter = writing_.parameter;
      written.value = writing_.value;
      answer(written);
    }
  }

  void carry_out(const link::Restart& request) {
    const Answer answer = unit_.restart(faults_);
    if (answer == Answer::taken) {
      ordering_ = request.kind;
    } else {
      refuse(request.kind, answer == Answer::self_test_failed
                               ? link::Reason::self_test_failed
                               : link::Reason::parameters_not_confirmed);
    }
  }

  /// A restart is done or refused before it is answered, and so is a new target.
  /// @param last  sequence number of the stop that overtook it
  void finish_order(OrderEnd end, std::uint32_t last) {
    if (end == OrderEnd::pending) {
      return;
    }
    const std::uint8_t request = ordering_;
    ordering_ = 0;
    if (end != OrderEnd::done) {
      if (faults_ != unit_.supervisor().faults().count()) {
        refuse(request, link::Reason::overtaken_by_fault);
      } else if (end == OrderEnd::tripped) {
        refuse(request, link::Reason::tripped);
      } else {
        refuse(request, link::Reason::out_of_turn, last, last);
      }
    } else if (request == link::Restart::kind) {
      answer(link::Restarted{});
    } else {
      link::TargetSet set{};
      set.target = unit_.target();
      answer(set);
    }
  }

  void carry_out(const link::ReadFault& request) {
    FaultEntry entry{};
    std::uint32_t count = 0;
    const auto& log = unit_.supervisor().faults();
    if (log.read(request.age, entry, count)) {
      answer(link::LoggedFault{request.age, entry.fault, entry.period, count});
    } else {
      refuse(request.kind, link::Reason::no_such_fault, 0, static_cast<std::uint32_t>(log.kept()));
    }
  }

  void carry_out(const link::ReadException& /*request*/) {
    if constexpr (has_history) {
      const auto& history = *Product::history;
      answer_exception(history.exception(), history[history.exceptions] > 0);
    } else {
      const bool known = Product::exception != nullptr;
      answer_exception(known ? hal::words_of(*Product::exception) : hal::ExceptionWords{}, known);
    }
  }

  void answer_exception(const hal::ExceptionWords& words, bool known) {
    if (!known) {
      refuse(link::ReadException::kind, link::Reason::no_such_fault);
    } else {
      answer(link::KeptException{words});
    }
  }

  void carry_out(const link::ReadHistory& /*request*/) {
    const auto& history = *Product::history;
    answer(link::History{history[history.boots], history[history.seconds],
                         history[history.watchdog_resets], history[history.exceptions],
                         history[history.exception_boot],
                         static_cast<std::uint8_t>(history.cause()),
                         static_cast<std::uint8_t>(history.saved() ? 1 : 0),
                         static_cast<std::uint8_t>(history.began_anew() ? 1 : 0)});
  }

  void carry_out(const link::ArmTrace& request) {
    if (request.triggers == 0 || request.triggers > link::all_triggers) {
      refuse(request.kind, link::Reason::out_of_range, 1, link::all_triggers);
    } else if (request.before >= trace_records) {
      refuse(request.kind, link::Reason::out_of_range, 0, trace_records - 1);
    } else {
      unit_.supervisor().trace().arm(request.triggers, request.before);
      link::TraceArmed armed{};
      armed.triggers = request.triggers;
      armed.before = request.before;
      answer(armed);
    }
  }

  void carry_out(const link::ReadTraceState& /*request*/) {
    const auto& trace = unit_.supervisor().trace();
    const auto state = trace.state();
    answer(link::TraceState{static_cast<std::uint8_t>(state.phase),
                            static_cast<std::uint8_t>(trace.extra), trace_records, state.cause,
                            state.before, state.first_period});
  }

  void carry_out(const link::ReadTraceRecord& request) {
    const auto& trace = unit_.supervisor().trace();
    const std::uint32_t there = trace.state().phase == link::TracePhase::whole ? trace_records : 0;
    if (request.index < there) {
      answer(trace.read(request.index));
    } else {
      refuse(request.kind, link::Reason::no_such_record, 0, there);
    }
  }

  // ---- Answers ----

  void refuse_value(std::uint8_t kind, const ParameterRange& range) {
    refuse(kind, link::Reason::out_of_range, range.lowest, range.highest);
  }

  void refuse_parameter(std::uint8_t kind) {
    refuse(kind, link::Reason::unknown_parameter, 0, parameter_count - 1);
  }

  [[gnu::cold, gnu::noinline]] void refuse(std::uint8_t kind, link::Reason reason,
                                           std::uint32_t lowest = 0, std::uint32_t highest = 0) {
    answer(link::Refusal{kind, static_cast<std::uint8_t>(reason), lowest, highest});
  }

  template <class Message>
  void answer(const Message& message) {
    answer_ = link::frame_of(message, sequence_);
    answered_ = true;
  }

  UnitT& unit_;
  TelemetryStream stream_;
  std::uint16_t sequence_ = 0;  ///< of the request in hand
  std::uint32_t faults_ = 0;    ///< since reset, when it came
  std::uint8_t saving_ = 0;     ///< its kind, while its save goes on
  std::uint8_t ordering_ = 0;   ///< its kind, while its order is pending
  bool answered_ = true;
  std::uint16_t lost_frames_ = 0;
  link::WriteParameter writing_{};
  link::Frame answer_;
};

}  // namespace sonoglide::app
