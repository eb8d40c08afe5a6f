/// What a simulated run comes to.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "firmware/control/interface/drive_command.hpp"
#include "firmware/numeric/signal_ledger.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/loop/control/friction_belief.hpp"
#include "host_sim/loop/electrical.hpp"
#include "host_sim/loop/plant/energy.hpp"
#include "host_sim/loop/plant/plant_port.hpp"
#include "host_sim/loop/plant/steady_orbit.hpp"

namespace sonoglide::loop {

/// Over the carrier periods of a run. Instructions, not cycles.
struct InstructionRange {
  std::uint32_t min;
  double mean;
  std::uint32_t max;
  std::uint32_t median;
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

/// Of the image, before it runs.
struct ImageMemory {
  std::uint64_t flash_bytes = 0;                   ///< code, constants, initial values
  std::uint64_t ram_bytes = 0;                     ///< static; the stack comes on top
  std::optional<std::uint64_t> stack_bytes_bound;  ///< worst case over all calls
  std::string stack_unbounded_by;                  ///< why there is no bound, if there is none
};

struct ImageRecord {
  std::string board;           ///< or the serial device that it was spoken to over
  bool counts_clocks = false;  ///< the costs of steps are clocks of the processor, not instructions
  std::optional<WorkstationRun> workstation;      ///< absent: not compared
  std::optional<double> exchanges_per_second;     ///< absent after fewer than two exchanges
  std::optional<ImageInstructions> instructions;  ///< absent without a single step
  std::optional<ImageMemory> memory;              ///< absent of an image that was there before
};

struct FaultEvent {
  double time_s;
  control::Fault fault;
};

/// What only a closed loop has.
struct ControlRecord {
  configure::ControlDesign design;
  std::uint64_t trace_hash = 0;  ///< FNV-1a over every drive command, bit for bit
  std::uint64_t commands = 0;
  std::uint64_t saturated_commands = 0;  ///< at the actuator's limit, a voltage's or a current's
  std::vector<FaultEvent> faults;        ///< a fault lasts: few
  std::vector<numeric::SignalRecord> signals;  ///< fixed point only
  std::optional<FrictionBelief> friction;      ///< at the end, in SI; learnt while driving only
};

/// As large after an hour as after a millisecond; what has a course is for a Watch.
struct RunResult {
  PlantState final_state{};
  double final_load_displacement_m = 0.0;  ///< 0 without a load
  double final_time_s = 0.0;
  std::uint64_t solver_steps = 0;
  std::uint64_t solver_events = 0;
  double wall_s = 0.0;
  EnergyBalance whole;
  EnergyBalance window;
  std::optional<ElectricalBalance> electrical;  ///< of the window; where there is a transducer
  /// Largest amplitude of the current's fundamental in a whole carrier period of the run; 0 without
  /// a transducer.
  double current_peak_A = 0.0;
  std::optional<SteadyOrbit> steady_orbit;  ///< where the run began on it
  std::optional<ControlRecord> control;
  std::optional<ImageRecord> image;  ///< whoever made the image fills it in
};

}  // namespace sonoglide::loop
