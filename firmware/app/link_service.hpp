/// Answers the requests that come over a framed link.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/app/identity.hpp"
#include "firmware/app/mismatch.hpp"
#include "firmware/app/unit.hpp"
#include "firmware/link/frame.hpp"
#include "firmware/link/messages.hpp"
#include "firmware/link/sequence.hpp"
#include "hal/serial_line.hpp"

namespace sonoglide::app {

/// Requests are answered one after the other. Up to three wait; one that comes then is counted as
/// lost. A stop never waits: the drive is at zero in the carrier period after its last byte, and
/// the stop is answered after the request at hand.
///
/// A fault overtakes the requests whose first byte came before it: they are refused. So a restart
/// that was sent before the fault does not end it.
///
/// A request that comes again is not carried out again: its answer is sent again. But what is read is
/// read anew, and a restart that comes again is refused as out of turn: an answer from memory would
/// tell a host of a restart that was another's. A request that is older than the last, or has its
/// number but other content, is refused with the number of the last, from which a host that has lost
/// count can go on. A hello begins the count anew. Damaged frames are counted and not answered.
///
/// @tparam ByteLink   see hal/board.hpp.
/// @tparam MostBytes  that a service takes in and sends at most: what comes between two services, see
///                    hal::bytes_in. 32 will do for 115200 baud and a service each 2.6 ms.
/// @tparam Product    what the unit says of itself: see Unnamed.
template <class UnitT, class ByteLink, std::size_t MostBytes = 32, class Product = Unnamed>
class LinkService {
  static_assert(hal::holds_two_services<ByteLink, MostBytes>,
                "the ring under a byte link holds two services' worth");

 public:
  LinkService(UnitT& unit, ByteLink& bytes) : unit_(unit), bytes_(bytes) {}

  // Cold, as all that is not control: for fewer bytes, not for speed.
  /// Receives what has come. Then it carries out one request, or takes one step of a save, and sends what
  /// there is room for.
  [[gnu::cold, gnu::noinline]] void serve() {
    for (std::size_t left = MostBytes; left > 0 && receive(); --left) {
    }
    proceed();
    for (std::size_t left = MostBytes; left > 0 && send_byte(); --left) {
    }
  }

 private:
  static constexpr std::size_t most_waiting = 3;

  struct Received {
    link::Frame frame{};
    std::uint32_t checksum = 0;
    std::uint32_t faults = 0;  ///< since reset, when its first byte came
  };

  void proceed() {
    if (ordering_ != 0) {
      finish_order(unit_.order_end());
    } else if (saving_ != 0) {
      finish_save(unit_.proceed());
    } else if (sent_ < encoder_.wire().size) {
      return;  // one answer after the other
    } else if (stopped_) {
      stopped_ = false;
      send(link::frame_of(link::Stopped{}, stop_sequence_));
    } else if (waiting_ > 0) {
      --waiting_;
      take(requests_[first_]);
      first_ = (first_ + 1) % most_waiting;
    }
  }

  /// @return whether a byte went out
  bool send_byte() {
    if (sent_ == encoder_.wire().size || !bytes_.send(encoder_.wire().bytes[sent_])) {
      return false;
    }
    ++sent_;
    return true;
  }

  // ---- Frames that come in ----

  /// @return whether there was a byte
  bool receive() {
    std::uint8_t byte = 0;
    if (!bytes_.receive(byte)) {
      return false;
    }
    take(byte);
    return true;
  }

  // Out of line, so that it stands once: most services find no byte.
  [[gnu::cold, gnu::noinline]] void take(std::uint8_t byte) {
    if (!decoder_.begun()) {
      faults_ = faults();
    }
    switch (decoder_.take(byte)) {
      case link::Reception::nothing:
        break;
      case link::Reception::frame:
        unit_.supervisor().hear_host();
        accept(decoder_.frame());
        break;
      case link::Reception::truncated:
      case link::Reception::oversized:
      case link::Reception::corrupted:
      case link::Reception::wrong_version:
        ++lost_frames_;
        break;
    }
  }

  void accept(const link::Frame& frame) {
    link::Stop stop{};
    if (link::read(frame, stop)) {
      unit_.stop();
      overtake(frame.sequence);
    } else if (waiting_ < most_waiting) {
      requests_[(first_ + waiting_) % most_waiting] = {frame, decoder_.checksum(), faults_};
      ++waiting_;
    } else {
      ++lost_frames_;
    }
  }

  /// A stop of that number. Waiting requests are older than it.
  void overtake(std::uint16_t sequence) {
    const link::Turn turn = turns_.take(sequence);
    if (turn == link::Turn::next || turn == link::Turn::skipped) {
      checksum_ = decoder_.checksum();
    }
    stopped_ = true;
    stop_sequence_ = sequence;
  }

  void take(const Received& request) {
    const link::Frame& frame = request.frame;
    if (frame.kind == link::Hello::kind) {
      turns_.restart();
    }
    const link::Turn turn = turns_.take(frame.sequence);
    const bool again = turn == link::Turn::repeated && request.checksum == checksum_;
    if (again && link::is_reading(frame.kind)) {
      dispatch(frame);
    } else if (again && frame.kind != link::Restart::kind) {
      send(answer_);
    } else if (turn == link::Turn::repeated || turn == link::Turn::late) {
      const std::uint32_t last = turns_.last();
      send(link::frame_of(refusal(frame.kind, link::Reason::out_of_turn, last, last),
                          frame.sequence));
    } else {
      checksum_ = request.checksum;
      sequence_ = frame.sequence;
      request_faults_ = request.faults;
      if (request.faults == faults()) {
        dispatch(frame);
      } else {
        refuse(frame.kind, link::Reason::overtaken_by_fault);
      }
    }
  }

  std::uint32_t faults() const { return unit_.supervisor().faults().count(); }

  void dispatch(const link::Frame& request) {
    if (request.kind == link::Stop::kind) {
      refuse(request.kind, link::Reason::wrong_length);  // one of the right length does not wait
      return;
    }
    const bool known = handles<link::ReadTelemetry>(request) || handles<link::SetTarget>(request) ||
                       handles<link::ReadParameter>(request) ||
                       handles<link::WriteParameter>(request) || handles<link::Restart>(request) ||
                       handles<link::ReadFault>(request) || handles<link::Confirm>(request) ||
                       handles<link::Hello>(request) || handles<link::ReadIdentity>(request);
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
    answer(link::Greeted{request.session, unit_.design()});
  }

  void carry_out(const link::ReadIdentity& /*request*/) {
    constexpr auto board = padded<link::most_name_characters>(Product::board);
    answer(link::Identity{version.major_number, version.minor_number, version.patch_number,
                          unit_.design(), Product::serial_number(), board});
  }

  void carry_out(const link::SetTarget& request) {
    if (unit_.set_target(request.target, request_faults_) == Answer::taken) {
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
    if (unit_.restart(request_faults_) == Answer::taken) {
      ordering_ = request.kind;
    } else {
      refuse(request.kind, link::Reason::parameters_not_confirmed);
    }
  }

  /// A restart is done or refused before it is answered, and so is a new target.
  void finish_order(OrderEnd end) {
    if (end == OrderEnd::pending) {
      return;
    }
    const std::uint8_t request = ordering_;
    ordering_ = 0;
    if (end == OrderEnd::overtaken) {
      if (request_faults_ != faults()) {
        refuse(request, link::Reason::overtaken_by_fault);
      } else {
        refuse(request, link::Reason::out_of_turn, turns_.last(), turns_.last());
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

  // ---- Answers ----

  void refuse_value(std::uint8_t kind, const ParameterRange& range) {
    refuse(kind, link::Reason::out_of_range, range.lowest, range.highest);
  }

  void refuse_parameter(std::uint8_t kind) {
    refuse(kind, link::Reason::unknown_parameter, 0, parameter_count - 1);
  }

  [[gnu::cold, gnu::noinline]] void refuse(std::uint8_t kind, link::Reason reason,
                                           std::uint32_t lowest = 0, std::uint32_t highest = 0) {
    answer(refusal(kind, reason, lowest, highest));
  }

  static link::Refusal refusal(std::uint8_t kind, link::Reason reason, std::uint32_t lowest,
                               std::uint32_t highest) {
    return {kind, static_cast<std::uint8_t>(reason), lowest, highest};
  }

  /// Answers the request at hand, and keeps the answer for a repetition.
  template <class Message>
  void answer(const Message& message) {
    answer_ = link::frame_of(message, sequence_);
    send(answer_);
  }

  [[gnu::cold, gnu::noinline]] void send(const link::Frame& frame) {
    encoder_.begin(frame);
    while (encoder_.busy()) {
      encoder_.proceed();
    }
    sent_ = 0;
  }

  UnitT& unit_;
  ByteLink& bytes_;
  link::FrameDecoder decoder_;
  std::array<Received, most_waiting> requests_{};  ///< that wait, from first_ on
  std::size_t first_ = 0;
  std::size_t waiting_ = 0;
  std::uint32_t faults_ = 0;  ///< since reset, when the frame that is being received began
  link::SequenceWatch turns_;
  std::uint32_t checksum_ = 0;        ///< of the last request
  std::uint16_t sequence_ = 0;        ///< of the request at hand
  std::uint16_t stop_sequence_ = 0;   ///< of the last stop
  bool stopped_ = false;              ///< and that is not yet answered
  std::uint8_t saving_ = 0;           ///< kind of the request whose save goes on
  std::uint8_t ordering_ = 0;         ///< kind of the request whose order is pending
  std::uint32_t request_faults_ = 0;  ///< since reset, when the request at hand came
  std::uint16_t lost_frames_ = 0;
  link::WriteParameter writing_{};
  link::Frame answer_;  ///< to the last request that was carried out
  link::FrameEncoder encoder_;
  std::size_t sent_ = 0;  ///< of the encoder's wire
};

}  // namespace sonoglide::app
