#include "host_sim/boards/emulated/lockstep_image.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "host_sim/process/printable.hpp"

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
  const auto end = std::chrono::steady_clock::now() + patience_;
  std::uint8_t byte = 0;
  receive(&byte, 1);
  while (greeted_ && period_ == 0 && byte == lockstep::greeting) {
    if (std::chrono::steady_clock::now() > end) {
      fail(fmt::format("greets, but for {} ms has answered no frame: does it receive?",
                       patience_.count()));
    }
    receive(&byte, 1);
  }
  return byte;
}

void SerialImage::receive(std::uint8_t* bytes, std::size_t size) {
  while (size > 0) {
    const std::size_t count = port_.receive(bytes, size, patience());
    if (count == 0) {
      fail(fmt::format("is silent for {} ms{}", patience().count(),
                       period() > 0 ? ""
                                    : "; reset the board, which must hold what image --lockstep "
                                      "builds of this scene"));
    }
    bytes += count;
    size -= count;
  }
}

void SerialImage::fail(const std::string& what) const {
  throw ImageError(fmt::format("{}: carrier period {}: the board {}",
                               process::printable(port_.device()), period(), what));
}

ImageProcess::ImageProcess(const std::vector<std::string>& command,
                           std::chrono::milliseconds patience)
    : LockstepImage(patience),
      samples_(process::make_pipe()),
      drives_(process::make_pipe()),
      // In memory: a pipe that nobody empties would stop a talkative emulator.
      complaints_(process::make_memory_file()) {
  // An emulator whose image waits for a sample hears no request to end.
  child_.emplace(command,
                 process::Streams{samples_.read_end.number(), drives_.write_end.number(),
                                  complaints_.number()},
                 SIGKILL);
  // The reading end of the samples stays open here: writing to an emulator that has died is then no
  // broken pipe, and its death shows where its answer is read.
  drives_.write_end.close();
}

void ImageProcess::send(const std::uint8_t* bytes, std::size_t size) {
  ssize_t count = 0;
  do {
    count = write(samples_.write_end.number(), bytes, size);
  } while (count < 0 && errno == EINTR);
  if (count != static_cast<ssize_t>(size)) {
    fail(std::string("cannot be sent a sample: ") + std::strerror(errno));
  }
}

int ImageProcess::shut_down() {
  samples_.write_end.close();
  samples_.read_end.close();
  // The output ends when the emulator does.
  std::uint8_t unasked = 0;
  wait_for_answer();
  if (read(drives_.read_end.number(), &unasked, 1) > 0) {
    fail("sent what nobody asked for");
  }
  const int status = child_->wait();
  if (!WIFEXITED(status)) {
    fail("ended with " + process::describe_end(status));
  }
  return WEXITSTATUS(status);
}

void ImageProcess::receive(std::uint8_t* bytes, std::size_t size) {
  while (size > 0) {
    wait_for_answer();
    const ssize_t count = read(drives_.read_end.number(), bytes, size);
    if (count <= 0) {
      fail("ended with " + process::describe_end(child_->wait()));
    }
    bytes += count;
    size -= static_cast<std::size_t>(count);
  }
}

void ImageProcess::wait_for_answer() {
  if (!process::wait_for_input(drives_.read_end.number(), patience())) {
    child_->end();
    fail(fmt::format("hung for {} ms and was ended", patience().count()));
  }
}

void ImageProcess::fail(const std::string& what) const {
  throw ImageError(
      fmt::format("carrier period {}: the emulator {}{}", period(), what, last_words()));
}

std::string ImageProcess::last_words() const {
  constexpr std::size_t most_bytes = 2000;
  const std::string text = process::memory_file_text(complaints_, most_bytes);
  return text.empty() ? ", without a word" : "; its last words:\n" + text;
}

}  // namespace sonoglide::emulated
