#include "host_sim/emulated/lockstep_image.hpp"

#include <fmt/format.h>

namespace sonoglide::emulated {

namespace lockstep = hal::lockstep;

void LockstepImage::await_greeting() {
  std::uint8_t byte = 0;
  receive(&byte, 1);
  if (byte != lockstep::greeting) {
    fail(fmt::format("greets with {}, as no image of image --lockstep does", byte));
  }
  greeted_ = true;
}

hal::Drive LockstepImage::exchange(const hal::Sample& sample) {
  return ask<hal::Drive>(sample);
}

hal::ResonantDrive LockstepImage::exchange(const hal::VibrationSample& sample) {
  return ask<hal::ResonantDrive>(sample);
}

hal::BiasedDrive LockstepImage::exchange_biased(const hal::Sample& sample) {
  return ask<hal::BiasedDrive>(sample);
}

hal::BiasedDrive LockstepImage::exchange_biased(const hal::MotionSample& sample) {
  return ask<hal::BiasedDrive>(sample);
}

template <class Drive, class Sample>
Drive LockstepImage::ask(const Sample& sample) {
  const auto question = lockstep::encode(period_, sample);
  send(question.data(), question.size());
  typename lockstep::FrameOf<Drive>::Type answer{};
  answer[0] = first_byte();
  receive(answer.data() + 1, answer.size() - 1);
  if (lockstep::period(answer) != period_) {
    fail(fmt::format("answered as for carrier period {}", lockstep::period(answer)));
  }
  ++period_;
  cost_ = lockstep::cost_of(answer);
  return lockstep::drive_of(answer);
}

/// Of an answer, behind the greetings that were sent before the board heard of a frame.
std::uint8_t LockstepImage::first_byte() {
  std::uint8_t byte = 0;
  do {
    receive(&byte, 1);
  } while (greeted_ && period_ == 0 && byte == lockstep::greeting);
  return byte;
}

}  // namespace sonoglide::emulated
