/// A line without flow control in simulated time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <ostream>
#include <vector>

#include "firmware/link/frame.hpp"
#include "hal/serial_line.hpp"
#include "tests/firmware/app/unit/simulated_unit.hpp"

namespace sonoglide::app {

/// Both directions of a line, with a queue of `queue_bytes` each beside the byte on the line. One that comes
/// and finds its queue full is lost.
class Uart {
 public:
  Uart(double byte_s, std::size_t queue_bytes) : byte_s_(byte_s), queue_bytes_(queue_bytes) {}

  // ---- The unit's ----

  bool receive(std::uint8_t& byte) {
    if (received_.empty()) {
      return false;
    }
    byte = received_.front();
    received_.pop_front();
    return true;
  }
  bool send(std::uint8_t byte) {
    if (!has_room()) {
      return false;
    }
    if (sending_.empty()) {
      sent_at_ = now + byte_s_;
    }
    sending_.push_back(byte);
    return true;
  }
  bool has_received() const { return !received_.empty(); }
  bool has_room() const { return sending_.size() <= queue_bytes_; }

  // ---- The line's ----

  void put(const std::vector<std::uint8_t>& bytes) {
    if (to_unit_.empty()) {
      comes_at_ = now + byte_s_;
    }
    to_unit_.insert(to_unit_.end(), bytes.begin(), bytes.end());
  }
  /// All has come, and was taken.
  bool idle() const { return to_unit_.empty() && received_.empty(); }

  /// When the next byte has come or gone.
  double next() const {
    return std::min(to_unit_.empty() ? never : comes_at_, sending_.empty() ? never : sent_at_);
  }
  void advance() {
    if (!to_unit_.empty() && comes_at_ <= now) {
      if (received_.size() < queue_bytes_) {
        received_.push_back(to_unit_.front());
      } else {
        ++lost;
      }
      to_unit_.pop_front();
      comes_at_ += byte_s_;
    }
    if (!sending_.empty() && sent_at_ <= now) {
      from_unit.push_back(sending_.front());
      sending_.pop_front();
      sent_at_ += byte_s_;
    }
  }

  double now = 0.0;
  int lost = 0;
  std::vector<std::uint8_t> from_unit;

 private:
  static constexpr double never = std::numeric_limits<double>::infinity();

  double byte_s_;
  std::size_t queue_bytes_;
  std::deque<std::uint8_t> to_unit_;
  std::deque<std::uint8_t> received_;
  std::deque<std::uint8_t> sending_;
  double comes_at_ = never;
  double sent_at_ = never;
};

struct Line {
  std::uint32_t baud;
  int carriers;  ///< in a service
  std::size_t queue_bytes;

  double byte_s() const { return 10.0 / baud; }
  double service_s() const { return carriers * carrier_period_s; }
  /// By which the interrupt may be late: nearly what the queue bears, and at most a carrier period.
  double latency_s() const {
    return 0.9 * std::min(static_cast<double>(queue_bytes) * byte_s(), carrier_period_s);
  }
  /// That a service may find.
  std::size_t most_bytes() const { return hal::bytes_in(baud, service_s() + latency_s()); }
};

inline std::ostream& operator<<(std::ostream& text, const Line& line) {
  return text << line.baud << " baud, " << line.carriers << " carriers a service, queue of "
              << line.queue_bytes;
}

inline std::vector<std::uint8_t> wire_bytes(const link::Frame& frame) {
  const link::WireFrame wire = link::encode(frame);
  return {wire.bytes.begin(), wire.bytes.begin() + static_cast<std::ptrdiff_t>(wire.size)};
}

}  // namespace sonoglide::app
