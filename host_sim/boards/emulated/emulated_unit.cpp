#include "host_sim/boards/emulated/emulated_unit.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <sstream>

#include "firmware/link/frame.hpp"
#include "firmware/link/messages.hpp"
#include "host_sim/boards/emulated/image.hpp"
#include "host_sim/boards/emulated/run_image.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/process/child_process.hpp"

namespace sonoglide::emulated {

EmulatedUnit::EmulatedUnit(const EmulatedBoard& board, const std::filesystem::path& image)
    : nothing_(open("/dev/null", O_RDONLY | O_CLOEXEC)),
      said_(process::make_pipe()),
      complaints_(process::make_memory_file()),
      emulator_(unit_emulator_command(board, image.string()),
                {nothing_.number(), said_.write_end.number(), complaints_.number()}, SIGKILL) {
  said_.write_end.close();
  device_ = await_device();
}

/// The emulator names it once the board runs.
std::string EmulatedUnit::await_device() {
  constexpr std::chrono::seconds patience{60};  // for each piece, on a busy machine
  const std::string begin = "redirected to ";
  std::string text;
  char byte = 0;
  while (process::wait_for_input(said_.read_end.number(), patience) &&
         read(said_.read_end.number(), &byte, 1) == 1) {
    text += byte;
    const std::size_t at = text.find(begin);
    if (at != std::string::npos && byte == ' ' && text.size() > at + begin.size()) {
      return text.substr(at + begin.size(), text.size() - 1 - at - begin.size());
    }
  }
  constexpr std::size_t most_bytes = 2000;
  throw process::ProcessError(fmt::format("the emulator names no serial device; it said:\n{}{}",
                                          text,
                                          process::memory_file_text(complaints_, most_bytes)));
}

namespace {

UnitSteps in_lockstep(const EmulatedBoard& board, const std::string& header,
                      const configure::Experiment& experiment, const loop::Watch& watch) {
  const loop::RunResult result =
      run_emulator(experiment, board, build_image(board, "_counted", header), watch);
  require_same(result);
  const loop::InstructionRange& step = result.image->instructions.value().step;
  return {step.median, step.max, result.control->commands, 0};
}

/// A restart as a host sends it, in hexadecimal.
std::string restart_frame() {
  link::FrameEncoder encoder;
  encoder.begin(link::frame_of(link::Restart{}, 1));
  while (encoder.busy()) {
    encoder.proceed();
  }
  std::string text;
  for (std::size_t i = 0; i < encoder.wire().size; ++i) {
    text += fmt::format("{:02x}", encoder.wire().bytes[i]);
  }
  return text;
}

/// Of a program for node.
UnitSteps on_carrier_board(const EmulatedBoard& board, const std::filesystem::path& unit) {
  constexpr std::uint64_t periods = 3000;  // half of what a host may be silent
  std::vector<std::string> command = node_command(board, "unit_steps.cjs");
  command.insert(command.end(), {unit.string(), fmt::format("{}", periods), restart_frame()});
  std::istringstream printed(process::run_tool(command));
  UnitSteps steps;
  steps.steps = periods;
  printed >> steps.median >> steps.most >> steps.period_clocks;
  return steps;
}

}  // namespace

UnitSteps unit_steps(const EmulatedBoard& board, const std::filesystem::path& unit,
                     const std::string& header, const configure::Experiment& experiment,
                     const loop::Watch& watch) {
  return board.emulator == "node" ? on_carrier_board(board, unit)
                                  : in_lockstep(board, header, experiment, watch);
}

}  // namespace sonoglide::emulated
