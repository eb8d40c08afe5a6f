#include "host_sim/boards/unit/unit_link.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <random>

#include "host_sim/process/printable.hpp"

namespace sonoglide::unit {
namespace {

using std::chrono::steady_clock;

/// Of a frame: a line may damage one.
constexpr int tries = 3;

std::uint16_t any_number() {
  return static_cast<std::uint16_t>(std::random_device{}());
}

/// Of the request before, where this one was refused as an older one.
std::optional<std::uint32_t> last_number(const link::Frame& answer) {
  link::Refusal refusal{};
  const bool out_of_turn = link::read(answer, refusal) &&
                           refusal.reason == static_cast<std::uint8_t>(link::Reason::out_of_turn);
  return out_of_turn ? std::optional(refusal.highest) : std::nullopt;
}

}  // namespace

UnitLink::UnitLink(process::SerialPort& port, std::chrono::milliseconds patience)
    : port_(port), patience_(patience), sequence_(any_number()) {
  const std::uint16_t session = any_number();
  const Result<link::Greeted> answer = ask<link::Greeted>(link::Hello{session});
  const auto* const greeted = std::get_if<link::Greeted>(&answer);
  if (greeted == nullptr) {
    fail("knows no hello: its firmware is not of this program");
  }
  if (greeted->session != session) {
    fail("answers another host");
  }
  stream({0, 1});  // where the unit has none, it says so
  streamed_.clear();
}

UnitLink::~UnitLink() {
  if (!streams_) {
    return;
  }
  try {
    const link::WireFrame wire = link::encode(link::frame_of(link::Stream{0, 1}, ++sequence_));
    port_.send(wire.bytes.data(), wire.size);
  } catch (const process::ProcessError&) {  // the device is gone, and its stream with it
  }
}

UnitLink::Result<link::Streaming> UnitLink::stream(const link::Stream& stream) {
  streams_ = stream.channels != 0;
  return ask<link::Streaming>(stream);
}

void UnitLink::send_stop() const noexcept {
  try {
    const link::WireFrame wire = link::encode(link::frame_of(link::Stop{}, 0));
    for (int i = 0; i < tries; ++i) {
      port_.send(wire.bytes.data(), wire.size);
    }
    port_.drain(std::chrono::milliseconds(500));
  } catch (const process::ProcessError&) {  // the device is gone
  }
}

link::Frame UnitLink::exchange(link::Frame request, std::chrono::milliseconds patience) {
  request.sequence = ++sequence_;
  link::Frame answer = answer_to(request, patience);
  if (const auto last = last_number(answer)) {
    sequence_ = static_cast<std::uint16_t>(*last + 1);
    request.sequence = sequence_;
    answer = answer_to(request, patience);
  }
  return answer;
}

link::Frame UnitLink::answer_to(const link::Frame& request, std::chrono::milliseconds patience) {
  const link::WireFrame wire = link::encode(request);
  link::Frame answer;
  for (int i = 0; i < tries; ++i) {
    port_.send(wire.bytes.data(), wire.size);
    if (receive(request.sequence, patience, answer)) {
      return answer;
    }
  }
  if (other_version_) {
    fail("speaks another version of the link: its firmware is not of this program");
  }
  if (heard_frame_) {
    fail("is a unit, but its answer comes too late");
  }
  fail(heard_bytes_ ? "answers, but not as a unit does" : "does not answer");
}

bool UnitLink::receive(std::uint16_t sequence, std::chrono::milliseconds patience,
                       link::Frame& answer) {
  const auto end = steady_clock::now() + patience;
  while (true) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(end - steady_clock::now());
    if (left.count() <= 0) {
      return false;
    }
    // Byte by byte, so that what follows the answer is there for the next.
    std::uint8_t byte = 0;
    if (port_.receive(&byte, 1, left) == 0) {
      continue;
    }
    if (take(byte) && decoder_.frame().sequence == sequence) {
      answer = decoder_.frame();
      return true;
    }
  }
}

bool UnitLink::take(std::uint8_t byte) {
  constexpr std::size_t most_kept = 65536;
  heard_bytes_ = true;
  const link::Reception reception = decoder_.take(byte);
  other_version_ |= reception == link::Reception::wrong_version;
  heard_frame_ |= reception == link::Reception::frame;
  if (reception != link::Reception::frame) {
    return false;
  }
  link::Streamed sample{};
  if (!link::read(decoder_.frame(), sample)) {
    return true;
  }
  streamed_.push_back(sample);
  if (streamed_.size() > most_kept) {
    streamed_.pop_front();
  }
  return false;
}

std::vector<link::Streamed> UnitLink::take_streamed() {
  std::array<std::uint8_t, 4096> bytes{};
  const std::size_t count = port_.receive(bytes.data(), bytes.size(), std::chrono::milliseconds(0));
  std::for_each_n(bytes.begin(), count, [this](std::uint8_t byte) { take(byte); });
  std::vector<link::Streamed> samples(streamed_.begin(), streamed_.end());
  streamed_.clear();
  return samples;
}

void UnitLink::fail(const std::string& reason) const {
  throw process::ProcessError(process::printable(port_.device()) + ": " + reason);
}

}  // namespace sonoglide::unit
