/// Requests to a unit and its answers.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <string>
#include <variant>
#include <vector>

#include "firmware/link/frame.hpp"
#include "firmware/link/messages.hpp"
#include "firmware/link/stream_messages.hpp"
#include "host_sim/process/serial_port.hpp"

namespace sonoglide::unit {

/// A save may take 10 s in the unit.
inline constexpr std::chrono::milliseconds longest_save{12000};

/// The host's end of the framed link (firmware/link). One request at a time. What a unit streams meanwhile
/// is kept until it is taken.
class UnitLink {
 public:
  static constexpr std::chrono::milliseconds usual_patience{400};

  /// Begins a session with a hello, so that a silent or foreign device is told at once. Ends a stream that a
  /// host before has left.
  /// @param port      outlives this
  /// @param patience  how long an answer may take: longer in an emulator on a busy machine
  /// @throws process::ProcessError  the device answers nothing, or nothing that a unit says
  explicit UnitLink(process::SerialPort& port, std::chrono::milliseconds patience = usual_patience);

  /// Ends the stream, if there is one, as far as a word without an answer does.
  ~UnitLink();
  UnitLink(const UnitLink&) = delete;
  UnitLink& operator=(const UnitLink&) = delete;

  template <class Answer>
  using Result = std::variant<Answer, link::Refusal>;

  /// @param work  of the unit, before it answers; some time later the request is sent again, twice
  /// @throws process::ProcessError  no answer came
  template <class Answer, class Request>
  Result<Answer> ask(const Request& request, std::chrono::milliseconds work = {}) {
    const link::Frame frame = exchange(link::frame_of(request, 0), patience_ + work);
    Answer answer{};
    if (link::read(frame, answer)) {
      return answer;
    }
    link::Refusal refusal{};
    if (!link::read(frame, refusal)) {
      fail("answers with a frame of another kind");
    }
    return refusal;
  }

  /// Begins a stream, or ends it where it has no channel.
  /// @throws process::ProcessError  no answer came
  Result<link::Streaming> stream(const link::Stream& stream);

  /// Sends a stop three times and waits for no answer, so that the process may end at once. Unlike all else it may be
  /// called while another thread asks: a unit obeys a stop of any sequence number.
  void send_stop() const noexcept;

  /// The samples of a stream that have come since the last call, in their order; of more than 65536 the
  /// latest. It does not wait.
  /// @throws process::ProcessError  the device is gone
  std::vector<link::Streamed> take_streamed();

  /// @throws process::ProcessError  the device, and what is wrong with it
  [[noreturn]] void fail(const std::string& reason) const;

 private:
  /// @return the answer to the request, whatever sequence number the latter has
  link::Frame exchange(link::Frame request, std::chrono::milliseconds patience);
  /// Sends it up to three times. A refusal is an answer too.
  link::Frame answer_to(const link::Frame& request, std::chrono::milliseconds patience);
  bool receive(std::uint16_t sequence, std::chrono::milliseconds patience, link::Frame& answer);
  /// @return whether it ends a frame that is no sample of a stream
  bool take(std::uint8_t byte);

  process::SerialPort& port_;
  std::chrono::milliseconds patience_;
  link::FrameDecoder decoder_;
  std::uint16_t sequence_;
  std::deque<link::Streamed> streamed_;
  bool heard_bytes_ = false;
  bool heard_frame_ = false;
  bool other_version_ = false;
  bool streams_ = false;
};

}  // namespace sonoglide::unit
