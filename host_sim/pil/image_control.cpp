#include "host_sim/pil/image_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sonoglide::pil {
namespace {

constexpr std::chrono::seconds longest_silence{10};

}  // namespace

ImageControl::ImageControl(const emulator::EmulatedBoard& board, const std::filesystem::path& image,
                           const process::Attention& attention)
    : board_(board),
      image_(emulator::emulator_command(board, image.string()), longest_silence, attention) {}

void ImageControl::set_target(double /*friction_ratio*/) {}

hal::Drive ImageControl::exchange(const hal::Sample& sample) {
  const hal::Drive drive = image_.exchange(sample);
  if (exchanges_ == 0) {
    first_answer_ = Clock::now();
  }
  ++exchanges_;
  account_for(image_.latest_count());
  return drive;
}

std::vector<numeric::SignalRecord> ImageControl::signals() const {
  return {};
}

loop::ImageRecord ImageControl::shut_down() {
  const std::chrono::duration<double> time = Clock::now() - first_answer_;
  const int code = image_.shut_down();
  if (code != 0) {
    throw EmulatorError(fmt::format("the image left with exit code {}", code));
  }
  loop::ImageRecord record;
  record.board = board_.name;
  if (exchanges_ > 1) {
    record.exchanges_per_second = static_cast<double>(exchanges_ - 1) / time.count();
  }
  if (exchanges_ > 0) {
    record.instructions = {fewest_instructions_,
                           static_cast<double>(all_instructions_) / static_cast<double>(exchanges_),
                           most_instructions_};
  }
  return record;
}

void ImageControl::account_for(std::uint32_t count) {
  const auto instructions =
      static_cast<std::uint32_t>(std::lround(count / board_.counts_per_instruction));
  fewest_instructions_ = std::min(fewest_instructions_, instructions);
  most_instructions_ = std::max(most_instructions_, instructions);
  all_instructions_ += instructions;
}

}  // namespace sonoglide::pil
