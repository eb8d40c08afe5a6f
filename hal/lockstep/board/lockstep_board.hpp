/// A board whose carrier periods come from a host, one frame at a time.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hal/board.hpp"
#include "hal/lockstep/frame.hpp"
#include "hal/start/counter.hpp"
#include "hal/start/image_end.hpp"

namespace sonoglide::hal::lockstep {

/// The processor's counter; it runs from its construction on.
class ProcessorCounter {
 public:
  ProcessorCounter() { start_counter(); }
  std::uint32_t read() const { return read_counter(); }
};

struct NoCounter {
  std::uint32_t read() const { return 0; }
};

/// Samples come from a link to the host, and drives go back over it. The end of the input shuts the
/// board down; a broken link ends the image (ExitCode::link_broken).
///
/// @tparam Link  offers
///   // waits; how many came until the end
///   std::size_t read(std::uint8_t* bytes, std::size_t size);
///   // whether every byte was taken
///   bool write(const std::uint8_t* bytes, std::size_t size);
/// @tparam Counter  offers std::uint32_t read() const, as read_counter() does
template <class Link, class Counter = NoCounter>
class LockstepBoard {
 public:
  // Neither call is inlined: the compiler would move work across the readings of the counter.

  /// @tparam SampleT  Sample | VibrationSample | MotionSample
  template <class SampleT>
  [[gnu::noinline]] bool sample(SampleT& sample) {
    typename FrameOf<SampleT>::Type frame{};
    const std::size_t received = link_.read(frame.data(), frame.size());
    arrival_ = counter_.read();
    if (received == 0) {
      return false;
    }
    require(received == frame.size() && period(frame) == period_);
    sample = sample_of(frame);
    handed_over_ = counter_.read();
    return true;
  }

  /// @tparam DriveT  Drive | ResonantDrive | BiasedDrive
  template <class DriveT>
  [[gnu::noinline]] void drive(const DriveT& drive) {
    const std::uint32_t taken = counter_.read();
    typename FrameOf<DriveT>::Type frame = encode(period_, drive);
    put_cost({taken - handed_over_ - reading_, counter_.read() - arrival_ - 3 * reading_}, frame);
    require(link_.write(frame.data(), frame.size()));
    ++period_;
  }

 private:
  static std::uint32_t reading_cost(const Counter& counter) {
    const std::uint32_t begin = counter.read();
    return counter.read() - begin;
  }

  static void require(bool intact) {
    if (!intact) {
      leave_image(static_cast<int>(ExitCode::link_broken));
    }
  }

  Link link_{};
  Counter counter_{};
  std::uint32_t reading_ = reading_cost(counter_);
  std::uint32_t arrival_ = 0;      ///< of the sample frame
  std::uint32_t handed_over_ = 0;  ///< the sample was
  std::uint32_t period_ = 0;
};

}  // namespace sonoglide::hal::lockstep
