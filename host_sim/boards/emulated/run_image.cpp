#include "host_sim/boards/emulated/run_image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>

#include "host_sim/boards/emulated/image.hpp"
#include "host_sim/boards/emulated/lockstep_image.hpp"
#include "host_sim/process/child_process.hpp"

namespace sonoglide::emulated {
namespace {

constexpr std::chrono::seconds longest_silence{10};

std::uint32_t instructions(std::uint32_t count, double counts_per_instruction) {
  return static_cast<std::uint32_t>(std::lround(count / counts_per_instruction));
}

}  // namespace

void InstructionCount::add(std::uint32_t instructions) {
  ++periods_[instructions];
}

loop::InstructionRange InstructionCount::range() const {
  std::uint64_t sum = 0;
  std::uint64_t count = 0;
  for (const auto& [instructions, periods] : periods_) {
    sum += instructions * periods;
    count += periods;
  }
  std::uint64_t below = 0;
  const auto median = std::find_if(periods_.begin(), periods_.end(), [&](const auto& each) {
    below += each.second;
    return 2 * below > count;
  });
  return {periods_.begin()->first, static_cast<double>(sum) / static_cast<double>(count),
          periods_.rbegin()->first, median->first};
}

void ImageControl::set_target(double /*friction_ratio*/) {}

template <class Drive>
Drive ImageControl::counted(const Drive& drive) {
  latest_answer_ = Clock::now();
  if (exchanges_ == 0) {
    first_answer_ = latest_answer_;
  }
  ++exchanges_;
  const hal::lockstep::AnswerCost cost = image_.latest_cost();
  step_.add(instructions(cost.step, counts_per_instruction_));
  answer_.add(instructions(cost.answer, counts_per_instruction_));
  return drive;
}

hal::Drive ImageControl::exchange(const hal::Sample& sample) {
  return counted(image_.exchange(sample));
}

hal::ResonantDrive ImageControl::exchange(const hal::VibrationSample& sample) {
  return counted(image_.exchange(sample));
}

hal::BiasedDrive ImageControl::exchange_biased(const hal::Sample& sample) {
  return counted(image_.exchange_biased(sample));
}

hal::BiasedDrive ImageControl::exchange_biased(const hal::MotionSample& sample) {
  return counted(image_.exchange_biased(sample));
}

std::vector<numeric::SignalRecord> ImageControl::signals() const {
  return {};
}

loop::ImageRecord ImageControl::record() const {
  const std::chrono::duration<double> time = latest_answer_ - first_answer_;
  loop::ImageRecord record;
  if (exchanges_ > 1) {
    record.exchanges_per_second = static_cast<double>(exchanges_ - 1) / time.count();
  }
  if (!step_.none()) {
    record.instructions = {step_.range(), answer_.range()};
  }
  return record;
}

namespace {

void shut_down(ImageProcess& image) {
  const int code = image.shut_down();
  if (code != 0) {
    throw ImageError(fmt::format("the image left with exit code {}", code));
  }
}

loop::ImageMemory memory_of(const ImageCost& cost) {
  loop::ImageMemory memory{cost.size.flash_bytes, cost.size.ram_bytes, {}, cost.stack.unbounded_by};
  if (cost.stack.unbounded_by.empty()) {
    memory.stack_bytes_bound = cost.stack.bytes;
  }
  return memory;
}

/// The image takes most of the time.
constexpr double image_share = 0.9;

loop::Watch of_the_image(loop::Watch watch) {
  if (watch.progress) {
    watch.progress = [progress = watch.progress](double part) { progress(image_share * part); };
  }
  return watch;
}

/// The same loop with the controller in this process, which tells what it has learnt, too.
void run_on_workstation(const configure::Experiment& experiment, const loop::Progress& progress,
                        loop::RunResult& result) {
  loop::Watch watch;
  if (progress) {
    watch.progress = [&](double part) { progress(image_share + (1.0 - image_share) * part); };
  }
  const loop::ControlRecord control = *loop::run(experiment, watch).control;
  result.image->workstation = {control.trace_hash,
                               control.trace_hash == result.control->trace_hash};
  result.control->friction = control.friction;
}

/// In lockstep with an image, and on the workstation.
loop::RunResult run_both(const configure::Experiment& experiment, ImageControl& controller,
                         const loop::Watch& watch) {
  loop::RunResult result =
      loop::run(experiment.plant, *experiment.design, controller, of_the_image(watch));
  result.image = controller.record();
  run_on_workstation(experiment, watch.progress, result);
  return result;
}

}  // namespace

loop::RunResult run_image(const configure::Experiment& experiment, const EmulatedBoard& board,
                          const std::string& header, const loop::Watch& watch) {
  const std::filesystem::path image = build_image(board, board.image_suffix, header);
  const loop::ImageMemory memory = memory_of(measure_image(image, board));
  loop::RunResult result = run_emulator(experiment, board, image, watch);
  result.image->memory = memory;
  return result;
}

loop::RunResult run_emulator(const configure::Experiment& experiment, const EmulatedBoard& board,
                             const std::filesystem::path& image, const loop::Watch& watch) {
  const process::OneCore core;
  ImageProcess process(run_command(board, image), longest_silence);
  ImageControl controller(process, board.counts_per_instruction);
  loop::RunResult result = run_both(experiment, controller, watch);
  shut_down(process);
  result.image->board = board.name;
  result.image->counts_clocks = !board.image_suffix.empty();
  return result;
}

loop::RunResult run_board(const configure::Experiment& experiment, process::SerialPort& port,
                          const loop::Watch& watch) {
  SerialImage board(port, longest_silence);
  board.await_greeting();
  ImageControl controller(board, hal::lockstep::counts_per_clock);
  loop::RunResult result = run_both(experiment, controller, watch);
  result.image->board = port.device();
  result.image->counts_clocks = true;
  return result;
}

void require_same(const loop::RunResult& result) {
  const loop::WorkstationRun& workstation = result.image->workstation.value();
  if (!workstation.same) {
    throw loop::ComputationError(fmt::format(
        "over {:g} s the image on {} gave other drive commands than the same controller on the "
        "workstation: trace hash {:016x}, not {:016x}",
        result.final_time_s, result.image->board, result.control->trace_hash,
        workstation.trace_hash));
  }
}

}  // namespace sonoglide::emulated
