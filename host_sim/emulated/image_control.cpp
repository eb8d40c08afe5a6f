#include "host_sim/emulated/image_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sonoglide::emulated {
namespace {

constexpr std::chrono::seconds longest_silence{10};

std::uint32_t instructions(std::uint32_t count, const emulated::EmulatedBoard& board) {
  return static_cast<std::uint32_t>(std::lround(count / board.counts_per_instruction));
}

}  // namespace

void InstructionCount::add(std::uint32_t instructions) {
  least_ = std::min(least_, instructions);
  most_ = std::max(most_, instructions);
  sum_ += instructions;
}

loop::InstructionRange InstructionCount::over(std::uint64_t periods) const {
  return {least_, static_cast<double>(sum_) / static_cast<double>(periods), most_};
}

ImageControl::ImageControl(const emulated::EmulatedBoard& board, const std::filesystem::path& image)
    : board_(board), image_(emulated::emulator_command(board, image.string()), longest_silence) {}

void ImageControl::set_target(double /*friction_ratio*/) {}

template <class Sample>
auto ImageControl::ask(const Sample& sample) {
  const auto drive = image_.exchange(sample);
  if (exchanges_ == 0) {
    first_answer_ = Clock::now();
  }
  ++exchanges_;
  const hal::lockstep::AnswerCost cost = image_.latest_cost();
  step_.add(instructions(cost.step, board_));
  answer_.add(instructions(cost.answer, board_));
  return drive;
}

hal::Drive ImageControl::exchange(const hal::Sample& sample) {
  return ask(sample);
}

hal::ResonantDrive ImageControl::exchange(const hal::VibrationSample& sample) {
  return ask(sample);
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
    record.instructions = {step_.over(exchanges_), answer_.over(exchanges_)};
  }
  return record;
}

}  // namespace sonoglide::emulated
