/// Answers the requests that come over a framed link.
#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware/app/link/frame.hpp"
#include "firmware/app/link/messages.hpp"
#include "firmware/app/link/sequence.hpp"
#include "firmware/app/unit.hpp"

namespace sonoglide::app {

/// One request at a time: nothing is received while its answer is made and sent.
///
/// A request that comes again is not carried out again: its answer is sent again. One that is older
/// than the last, or bears the last's number but says something else, is refused with the number of
/// the last, so that a host which has lost count goes on from there. Damaged frames are counted and
/// not answered.
///
/// @tparam ByteLink  see hal/board.hpp.
template <class UnitT, class ByteLink>
class LinkService {
 public:
  LinkService(UnitT& unit, ByteLink& bytes) : unit_(unit), bytes_(bytes) {}

  /// One byte received, encoded or sent; one request carried out; or one step of a save.
  void serve() {
    if (requested_) {
      requested_ = false;
      take(decoder_.frame());
    } else if (saving_) {
      finish_write(unit_.proceed());
    } else if (encoder_.busy()) {
      encoder_.proceed();
    } else if (sent_ < encoder_.wire().size) {
      sent_ += bytes_.send(encoder_.wire().bytes[sent_]) ? 1U : 0U;
    } else {
      receive();
    }
  }

 private:
  void receive() {
    std::uint8_t byte = 0;
    if (!bytes_.receive(byte)) {
      return;
    }
    switch (decoder_.take(byte)) {
      case link::Reception::nothing:
        break;
      case link::Reception::frame:
        requested_ = true;
        break;
      case link::Reception::truncated:
      case link::Reception::oversized:
      case link::Reception::corrupted:
      case link::Reception::wrong_version:
        ++damaged_frames_;
        break;
    }
  }

  void take(const link::Frame& request) {
    const link::Turn turn = turns_.take(request.sequence);
    if (turn == link::Turn::repeated && decoder_.checksum() == checksum_) {
      send(answer_);
    } else if (turn == link::Turn::repeated || turn == link::Turn::late) {
      const std::uint32_t last = turns_.last();
      send(link::frame_of(refusal(request.kind, link::Reason::out_of_turn, last, last),
                          request.sequence));
    } else {
      checksum_ = decoder_.checksum();
      dispatch(request);
    }
  }

  void dispatch(const link::Frame& request) {
    const bool known = handles<link::ReadTelemetry>(request) || handles<link::SetTarget>(request) ||
                       handles<link::ReadParameter>(request) ||
                       handles<link::WriteParameter>(request) || handles<link::Restart>(request) ||
                       handles<link::Stop>(request) || handles<link::ReadFault>(request);
    if (!known) {
      refuse(request.kind, link::Reason::unknown_request);
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

  void carry_out(const link::ReadTelemetry& /*request*/) {
    const auto& supervisor = unit_.supervisor();
    const hal::Sample& sample = supervisor.sample();
    const hal::Drive& drive = supervisor.drive();
    answer(link::Telemetry{supervisor.periods(), sample.friction_force, sample.sliding_velocity,
                           drive.amplitude, unit_.target(), drive.state, drive.limit, drive.fault,
                           static_cast<std::uint8_t>(unit_.origin()), damaged_frames_});
  }

  void carry_out(const link::SetTarget& request) {
    if (unit_.set_target(request.ratio) == Answer::taken) {
      link::TargetSet set{};
      set.ratio = request.ratio;
      answer(set);
    } else {
      refuse_value(request.kind, unit_.info(Parameter::target));
    }
  }

  void carry_out(const link::ReadParameter& request) {
    if (request.parameter >= parameter_count) {
      refuse_parameter(request.kind);
      return;
    }
    const ParameterInfo& info = unit_.info(request.parameter);
    answer(link::ParameterValue{request.parameter, info.decimal_places,
                                unit_.value(request.parameter), info.lowest, info.highest,
                                info.preset});
  }

  void carry_out(const link::WriteParameter& request) {
    switch (unit_.write(request.parameter, request.value)) {
      case Answer::taken:
        writing_ = request;
        saving_ = true;
        break;
      case Answer::out_of_range:
        refuse_value(request.kind, unit_.info(request.parameter));
        break;
      case Answer::unknown_parameter:
        refuse_parameter(request.kind);
        break;
      case Answer::drive_not_stopped:
        refuse(request.kind, link::Reason::drive_not_stopped);
        break;
    }
  }

  void finish_write(store::Saving saving) {
    if (saving == store::Saving::busy) {
      return;
    }
    saving_ = false;
    if (saving == store::Saving::saved) {
      link::ParameterWritten written{};
      written.parameter = writing_.parameter;
      written.value = writing_.value;
      answer(written);
    } else {
      refuse(writing_.kind, link::Reason::not_saved);
    }
  }

  void carry_out(const link::Restart& /*request*/) {
    unit_.supervisor().restart();
    answer(link::Restarted{});
  }

  void carry_out(const link::Stop& /*request*/) {
    unit_.supervisor().stop();
    answer(link::Stopped{});
  }

  void carry_out(const link::ReadFault& request) {
    const auto& faults = unit_.supervisor().faults();
    if (request.age >= faults.kept()) {
      refuse(request.kind, link::Reason::no_such_fault, 0,
             static_cast<std::uint32_t>(faults.kept()));
      return;
    }
    const FaultEntry& entry = faults.entry(request.age);
    answer(link::LoggedFault{request.age, entry.fault, entry.period, faults.count()});
  }

  void refuse_value(std::uint8_t kind, const ParameterInfo& info) {
    refuse(kind, link::Reason::out_of_range, info.lowest, info.highest);
  }

  void refuse_parameter(std::uint8_t kind) {
    refuse(kind, link::Reason::unknown_parameter, 0, parameter_count - 1);
  }

  [[gnu::noinline]] void refuse(std::uint8_t kind, link::Reason reason, std::uint32_t lowest = 0,
                                std::uint32_t highest = 0) {
    answer(refusal(kind, reason, lowest, highest));
  }

  static link::Refusal refusal(std::uint8_t kind, link::Reason reason, std::uint32_t lowest,
                               std::uint32_t highest) {
    return {kind, static_cast<std::uint8_t>(reason), lowest, highest};
  }

  /// Answers the last request, and keeps the answer for a repetition.
  template <class Message>
  void answer(const Message& message) {
    answer_ = link::frame_of(message, turns_.last());
    send(answer_);
  }

  [[gnu::noinline]] void send(const link::Frame& frame) {
    encoder_.begin(frame);
    sent_ = 0;
  }

  UnitT& unit_;
  ByteLink& bytes_;
  link::FrameDecoder decoder_;
  link::SequenceWatch turns_;
  std::uint32_t checksum_ = 0;  ///< of the last request
  link::Frame answer_;          ///< to the last request
  link::FrameEncoder encoder_;
  std::size_t sent_ = 0;  ///< of the encoder's wire
  link::WriteParameter writing_{};
  bool requested_ = false;
  bool saving_ = false;
  std::uint16_t damaged_frames_ = 0;
};

}  // namespace sonoglide::app
