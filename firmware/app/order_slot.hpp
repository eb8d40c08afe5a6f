/// One order from the service to the control of a unit, and stops that overtake it, without a lock.
#pragma once

#include <atomic>
#include <cstdint>

namespace sonoglide::app {

enum class OrderEnd : std::uint8_t {
  pending,    ///< not yet taken
  done,       ///< carried out
  overtaken,  ///< a stop or a fault came after it; it is not carried out
  tripped,    ///< the board's hardware holds the drive off; it is not carried out
};

/// The service posts one order, and the next when that one has ended. The control side takes it, or
/// ends it because a stop came later. Both sides only load and store: a processor without exchange
/// instructions will do, and neither side waits.
///
/// A stop that is posted after an order is seen before or with it, never later: so an order that was
/// taken before its stop is followed by the stop in the next carrier period.
template <class Content, template <class> class Atomic = std::atomic>
class OrderSlot {
 public:
  /// @param arguments  of the first content
  template <class... Arguments>
  explicit OrderSlot(const Arguments&... arguments) : content_(arguments...) {}

  // ---- The service's ----

  void stop() {
    stops_.store(++stops_posted_, std::memory_order_release);
    call();
  }

  /// To be filled in before post(); not while an order is pending.
  Content& draft() { return content_; }

  void post() {
    content_stops_ = stops_posted_;
    posted_.store(++orders_posted_, std::memory_order_release);
    call();
  }

  /// Of the order posted last.
  OrderEnd end() const {
    return ended_.load(std::memory_order_acquire) == orders_posted_ ? end_ : OrderEnd::pending;
  }

  // ---- The control side's, once in each carrier period ----

  /// What there is to do. A stop comes before an order.
  struct Work {
    bool stop;
    const Content* order;  ///< none: null. To be ended by finish()
  };

  Work look() {
    // The count before the words, and heeded only after a look that found nothing: none is lost.
    const std::uint32_t calls = calls_.load(std::memory_order_acquire);
    if (calls == calls_heeded_) {
      return {false, nullptr};
    }
    // The order first: the stops that it knows of are then there too.
    const bool ordered = posted_.load(std::memory_order_acquire) != orders_ended_;
    const std::uint32_t stops = stops_.load(std::memory_order_acquire);
    if (stops != stops_heeded_) {
      stops_heeded_ = stops;
      if (ordered && content_stops_ != stops) {
        finish(OrderEnd::overtaken);
      }
      return {true, nullptr};
    }
    if (ordered) {
      return {false, &content_};
    }
    calls_heeded_ = calls;
    return {false, nullptr};
  }

  void finish(OrderEnd end) {
    end_ = end;
    ended_.store(++orders_ended_, std::memory_order_release);
  }

 private:
  /// After the stop or order that it announces.
  void call() { calls_.store(++calls_made_, std::memory_order_release); }

  std::uint32_t content_stops_ = 0;  ///< stops that were posted before the order
  OrderEnd end_ = OrderEnd::done;
  std::uint32_t orders_posted_ = 0;  ///< of the service alone, as the next
  std::uint32_t stops_posted_ = 0;
  std::uint32_t calls_made_ = 0;
  std::uint32_t orders_ended_ = 0;  ///< of the control side alone, as the next
  std::uint32_t stops_heeded_ = 0;
  std::uint32_t calls_heeded_ = 0;  ///< all of them were seen
  Atomic<std::uint32_t> calls_{0};  ///< stops and orders together
  Atomic<std::uint32_t> posted_{0};
  Atomic<std::uint32_t> stops_{0};
  Atomic<std::uint32_t> ended_{0};
  Content
      content_;  ///< last: small processors reach what is near the beginning by fewer instructions
};

}  // namespace sonoglide::app
