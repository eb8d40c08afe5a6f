/// What only a controller in an image has to tell.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace sonoglide::loop {

/// Over the carrier periods of a run. Instructions, not cycles.
struct InstructionRange {
  std::uint32_t min;
  double mean;
  std::uint32_t max;
};

struct ImageInstructions {
  InstructionRange step;    ///< from a sample's codes to the drive's
  InstructionRange answer;  ///< the same, with the frames of lockstep decoded and made up
};

/// The same loop with the controller in this process.
struct WorkstationRun {
  std::uint64_t trace_hash;  ///< as ControlRecord has it
  bool same;                 ///< every drive command is the image's, bit for bit
};

struct ImageRecord {
  std::string board;
  std::optional<WorkstationRun> workstation;       ///< absent: not compared
  std::optional<double> exchanges_per_second;      ///< absent after fewer than two exchanges
  std::optional<ImageInstructions> instructions;   ///< absent without a single step
  std::uint64_t flash_bytes = 0;                   ///< code, constants, initial values
  std::uint64_t ram_bytes = 0;                     ///< static; the stack comes on top
  std::optional<std::uint64_t> stack_bytes_bound;  ///< worst case over all calls
  std::string stack_unbounded_by;                  ///< why there is no bound, if there is none
};

}  // namespace sonoglide::loop
