/// What the host and the service show of themselves, and how long they have not.
#pragma once

#include <atomic>
#include <cstdint>

namespace sonoglide::app {

/// The service counts, the control side compares in each carrier period; no side waits for the other.
template <template <class> class Atomic = std::atomic>
class SignsOfLife {
 public:
  /// @param timeout_periods  for which the host may be silent; 0: for ever
  /// @param service_periods  in which the service comes round
  SignsOfLife(std::uint32_t timeout_periods, std::uint32_t service_periods)
      : timeout_periods_(timeout_periods), service_periods_(service_periods) {}

  // ---- The service's ----

  /// The host gave a sign of life.
  void hear_host() { heard_.store(++heard_by_service_, std::memory_order_release); }
  /// The service comes round.
  void note_service() { rounds_.store(++rounds_of_service_, std::memory_order_release); }

  // ---- The control side's ----

  void set_timeout(std::uint32_t periods) { timeout_periods_ = periods; }
  /// As if the host had just spoken.
  void excuse_host() { silent_periods_ = 0; }

  /// Once in a carrier period: whether it matters if the host is silent.
  bool listen() {
    const std::uint32_t heard = heard_.load(std::memory_order_acquire);
    if (heard != heard_last_) {
      heard_last_ = heard;
      silent_periods_ = 0;
    }
    return timeout_periods_ != 0;
  }
  /// After listen(), in a period in which the unit drives: whether the host has been silent for too long.
  bool misses_host() { return silent_periods_++ >= timeout_periods_; }

  /// Once in a carrier period.
  /// @return whether the service has not come round for its time
  bool misses_service() {
    const std::uint32_t rounds = rounds_.load(std::memory_order_acquire);
    if (rounds != rounds_last_) {
      rounds_last_ = rounds;
      stalled_periods_ = 0;
      return false;
    }
    stalled_periods_ += serviced() ? 1U : 0U;
    return !serviced();
  }

  /// The service came round of late.
  bool serviced() const { return stalled_periods_ < service_periods_; }

 private:
  std::uint32_t timeout_periods_;
  std::uint32_t service_periods_;
  std::uint32_t silent_periods_ = 0;
  std::uint32_t stalled_periods_ = 0;
  std::uint32_t heard_last_ = 0;
  std::uint32_t rounds_last_ = 0;
  std::uint32_t heard_by_service_ = 0;
  std::uint32_t rounds_of_service_ = 0;
  Atomic<std::uint32_t> heard_{0};
  Atomic<std::uint32_t> rounds_{0};
};

}  // namespace sonoglide::app
