/// A serial line without flow control: how much may come, and rings that hold it.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace sonoglide::hal {

/// Bytes that begin on a line within a time, at most: a start bit, 8 bits and a stop bit each.
/// @param baud    bits a second
/// @param time_s  for example between two services, and by which an interrupt may be late
constexpr std::size_t bytes_in(std::uint32_t baud, double time_s) {
  return static_cast<std::size_t>(baud * time_s / 10) + 1;
}

/// Bytes from one side to another of which one may interrupt the other; neither waits.
///
/// @tparam Capacity  largest number of bytes that wait
template <std::size_t Capacity>
class ByteRing {
 public:
  /// @return false: full, the byte is lost
  bool put(std::uint8_t byte) {
    const std::size_t put = put_.load(std::memory_order_relaxed);
    const std::size_t after = next(put);
    if (after == taken_.load(std::memory_order_acquire)) {
      return false;
    }
    bytes_[put] = byte;
    put_.store(after, std::memory_order_release);
    return true;
  }

  /// @return false: empty
  bool take(std::uint8_t& byte) {
    const std::size_t taken = taken_.load(std::memory_order_relaxed);
    if (taken == put_.load(std::memory_order_acquire)) {
      return false;
    }
    byte = bytes_[taken];
    taken_.store(next(taken), std::memory_order_release);
    return true;
  }

  bool empty() const {
    return taken_.load(std::memory_order_acquire) == put_.load(std::memory_order_acquire);
  }

 private:
  static constexpr std::size_t next(std::size_t at) { return at < Capacity ? at + 1 : 0; }

  std::array<std::uint8_t, Capacity + 1> bytes_{};
  std::atomic<std::size_t> put_{0};    ///< where the next byte goes
  std::atomic<std::size_t> taken_{0};  ///< where the next one comes from
};

/// A byte link with rings under it, for a UART whose own queue is shorter than what comes between two
/// services. The UART's interrupt calls transfer(): when a byte has come, and, while sending(), when
/// there is room for one.
///
/// @tparam Uart      has receive() and send() as a byte link, see hal/board.hpp
/// @tparam Received  bytes that may wait for the service: two services' worth, see bytes_in()
/// @tparam Sent      bytes that may wait for the line; what a service sends, so that the line never pauses
template <class Uart, std::size_t Received, std::size_t Sent>
class BufferedLink {
 public:
  static constexpr std::size_t received_bytes = Received;

  /// @param uart  outlives this
  explicit BufferedLink(Uart& uart) : uart_(uart) {}

  // ---- The service's ----

  bool receive(std::uint8_t& byte) { return received_.take(byte); }
  bool send(std::uint8_t byte) { return sent_.put(byte); }

  /// Something waits for the line: the interrupt of an idle transmitter is to be enabled.
  bool sending() const { return held_ || !sent_.empty(); }

  // ---- The interrupt's ----

  void transfer() {
    std::uint8_t byte = 0;
    while (uart_.receive(byte)) {
      received_.put(byte);  // without room it is lost, and costs its frame
    }
    while (held_ || sent_.take(next_)) {
      held_ = !uart_.send(next_);
      if (held_) {
        return;
      }
    }
  }

 private:
  Uart& uart_;
  ByteRing<Received> received_;
  ByteRing<Sent> sent_;
  std::uint8_t next_ = 0;  ///< of the line, if held_
  std::atomic<bool> held_{false};
};

namespace detail {

template <class ByteLink, class = void>
struct RingBytes {
  static constexpr std::size_t value = SIZE_MAX;  // none: nobody but the UART holds bytes
};
template <class ByteLink>
struct RingBytes<ByteLink, std::void_t<decltype(ByteLink::received_bytes)>> {
  static constexpr std::size_t value = ByteLink::received_bytes;
};

}  // namespace detail

/// Whether the ring under a byte link, if there is one, holds twice as many bytes as a service takes.
template <class ByteLink, std::size_t MostBytes>
inline constexpr bool holds_two_services = detail::RingBytes<ByteLink>::value / 2 >= MostBytes;

}  // namespace sonoglide::hal
