#include "host_sim/emulated/unit_steps.hpp"

#include <fmt/format.h>

#include <sstream>

#include "firmware/link/frame.hpp"
#include "firmware/link/messages.hpp"
#include "host_sim/emulated/image.hpp"
#include "host_sim/emulated/run_image.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/process/child_process.hpp"

namespace sonoglide::emulated {
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
