/// Answers the requests that come over a framed link.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/app/identity.hpp"
#include "firmware/app/unit_requests.hpp"
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
/// A sample of a stream is sent while nothing else is. An answer cuts it short: the host finds a damaged
/// frame in its place.
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
  LinkService(UnitT& unit, ByteLink& bytes) : unit_(unit), bytes_(bytes), requests_(unit) {}

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
    if (requests_.in_hand()) {
      requests_.proceed(turns_.last());
      answer_if_ready();
    } else if (sends() && !streams_) {
      // one answer after the other
    } else if (stopped_) {
      stopped_ = false;
      send(link::frame_of(link::Stopped{}, stop_sequence_));
    } else if (waiting_ > 0) {
      --waiting_;
      take(queue_[first_]);
      first_ = (first_ + 1) % most_waiting;
    }
    requests_.serve_history();
    link::Streamed sample{};
    if (requests_.take_sample(sample, !sends())) {
      send(link::frame_of(sample));
      streams_ = true;
    }
  }

  bool sends() const { return sent_ < encoder_.wire().size; }

  void answer_if_ready() {
    if (!requests_.in_hand()) {
      send(requests_.answer());
    }
  }

  /// @return whether a byte went out
  bool send_byte() {
    if (!sends() || !bytes_.send(encoder_.wire().bytes[sent_])) {
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
        requests_.count_lost_frame();
        break;
    }
  }

  void accept(const link::Frame& frame) {
    link::Stop stop{};
    if (link::read(frame, stop)) {
      unit_.stop();
      requests_.note_stop();
      overtake(frame.sequence);
    } else if (waiting_ < most_waiting) {
      queue_[(first_ + waiting_) % most_waiting] = {frame, decoder_.checksum(), faults_};
      ++waiting_;
    } else {
      requests_.count_lost_frame();
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
      requests_.take_again(frame);
      answer_if_ready();
    } else if (again && frame.kind != link::Restart::kind) {
      send(requests_.answer());
    } else if (turn == link::Turn::repeated || turn == link::Turn::late) {
      constexpr auto out_of_turn = static_cast<std::uint8_t>(link::Reason::out_of_turn);
      const std::uint32_t last = turns_.last();
      send(link::frame_of(link::Refusal{frame.kind, out_of_turn, last, last}, frame.sequence));
    } else {
      checksum_ = request.checksum;
      requests_.take(frame, request.faults);
      answer_if_ready();
    }
  }

  std::uint32_t faults() const { return unit_.supervisor().faults().count(); }

  [[gnu::cold, gnu::noinline]] void send(const link::Frame& frame) {
    encoder_.begin(frame);
    while (encoder_.busy()) {
      encoder_.proceed();
    }
    sent_ = 0;
    streams_ = false;
  }

  UnitT& unit_;
  ByteLink& bytes_;
  link::FrameDecoder decoder_;
  std::array<Received, most_waiting> queue_{};  ///< from first_ on
  std::size_t first_ = 0;
  std::size_t waiting_ = 0;
  std::uint32_t faults_ = 0;  ///< since reset, when the frame that is being received began
  link::SequenceWatch turns_;
  std::uint32_t checksum_ = 0;       ///< of the last request
  std::uint16_t stop_sequence_ = 0;  ///< of the last stop
  bool stopped_ = false;             ///< and that is not yet answered
  UnitRequests<UnitT, Product> requests_;
  link::FrameEncoder encoder_;
  std::size_t sent_ = 0;  ///< of the encoder's wire
  bool streams_ = false;  ///< that is a sample, which an answer cuts short
};

}  // namespace sonoglide::app
