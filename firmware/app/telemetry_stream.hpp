/// What a unit shows its host unasked, as the line permits.
#pragma once

#include <cstdint>

#include "firmware/app/commanded_supervisor.hpp"
#include "firmware/link/stream_messages.hpp"

namespace sonoglide::app {

/// Sample n is due n times `every` periods after the stream began. One whose turn passes before the
/// line is free is left out, and its number with it.
class TelemetryStream {
 public:
  /// @param wanted  its channels allowed, its `every` at least 1
  /// @param period  in which the first sample is due
  void begin(const link::Stream& wanted, std::uint32_t period) {
    channels_ = wanted.channels;
    every_ = wanted.every;
    due_ = period;
    next_ = 0;
    waits_ = false;
  }
  void end() { channels_ = 0; }
  bool running() const { return channels_ != 0; }

  /// Takes note of the period, in each service while the stream runs.
  /// @return whether a sample waits to be shown
  bool waits(std::uint32_t period) {
    const std::uint32_t late = period - due_;
    if (late < UINT32_C(1) << 31) {
      const std::uint32_t passed = late / every_ + 1;
      due_ += passed * every_;
      next_ = static_cast<std::uint16_t>(next_ + passed);
      waits_ = true;
    }
    return waits_;
  }

  /// The sample that waits.
  /// @param shown   its values
  /// @param target  see link::Channel
  link::Streamed take(const Snapshot& shown, std::uint32_t target) {
    waits_ = false;
    const hal::Drive& drive = shown.drive;
    return {static_cast<std::uint16_t>(next_ - 1),
            channels_,
            shown.periods,
            {static_cast<std::uint32_t>(shown.friction_force),
             static_cast<std::uint32_t>(shown.sliding_velocity),
             static_cast<std::uint32_t>(drive.amplitude),
             static_cast<std::uint32_t>(drive.commanded_ratio), target, codes_of(drive)}};
  }

 private:
  std::uint8_t channels_ = 0;
  bool waits_ = false;  ///< number next_ - 1 is due, and not shown
  std::uint16_t every_ = 1;
  std::uint16_t next_ = 0;  ///< number of the sample that is due next
  std::uint32_t due_ = 0;   ///< its period
};

}  // namespace sonoglide::app
