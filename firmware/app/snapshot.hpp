/// A carrier period as the service sees it.
#pragma once

#include <atomic>
#include <cstdint>

#include "firmware/app/sequence_lock.hpp"
#include "firmware/control/interface/drive_command.hpp"
#include "hal/board.hpp"

namespace sonoglide::app {

/// What a carrier period showed and what was answered.
struct Snapshot {
  std::uint32_t periods;  ///< served since reset, wraps
  std::int32_t friction_force;
  std::int32_t sliding_velocity;
  hal::Drive drive;

  /// The controller runs, or the drive ramps down.
  bool driving() const {
    return control::runs(static_cast<control::State>(drive.state)) || drive.amplitude != 0;
  }
};

/// State, limit, fault and settling, from the lowest byte on.
constexpr std::uint32_t codes_of(const hal::Drive& drive) {
  return drive.state | std::uint32_t{drive.limit} << 8 | std::uint32_t{drive.fault} << 16 |
         std::uint32_t{drive.settling} << 24;
}

/// The control side shows each period, the service reads the latest, whole.
template <template <class> class Atomic = std::atomic>
class ShownPeriod {
 public:
  template <class SupervisorT>
  void show(const SupervisorT& supervisor) {
    const hal::Drive& drive = supervisor.drive();
    words_.write_whole([&] {
      words_.write(0, supervisor.periods());
      words_.write(1, static_cast<std::uint32_t>(supervisor.friction_force()));
      words_.write(2, static_cast<std::uint32_t>(supervisor.sliding_velocity()));
      words_.write(3, static_cast<std::uint32_t>(drive.amplitude));
      words_.write(4, static_cast<std::uint32_t>(drive.commanded_ratio));
      words_.write(5, codes_of(drive));
    });
  }

  Snapshot snapshot() const {
    Snapshot result{};
    words_.read_whole([&] {
      result.periods = words_.read(0);
      result.friction_force = static_cast<std::int32_t>(words_.read(1));
      result.sliding_velocity = static_cast<std::int32_t>(words_.read(2));
      const std::uint32_t codes = words_.read(5);
      result.drive = {
          static_cast<std::int32_t>(words_.read(3)), static_cast<std::int32_t>(words_.read(4)),
          static_cast<std::uint8_t>(codes),          static_cast<std::uint8_t>(codes >> 8),
          static_cast<std::uint8_t>(codes >> 16),    static_cast<std::uint8_t>(codes >> 24)};
    });
    return result;
  }

 private:
  SequenceLock<6, Atomic> words_;
};

}  // namespace sonoglide::app
