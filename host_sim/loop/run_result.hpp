/// What a simulated run leaves behind.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "firmware/control/drive_command.hpp"
#include "firmware/numeric/signal_ledger.hpp"
#include "host_sim/loop/energy.hpp"
#include "host_sim/loop/plant_port.hpp"
#include "host_sim/loop/recorder.hpp"
#include "host_sim/scene/control_design.hpp"

namespace sonoglide::loop {

/// One carrier period (where there is no drive: one thousandth of the run).
struct Period {
  double begin_s;
  double end_s;
  double friction_ratio;          ///< mean F·sgn(Vt) over Fc, sgn(0) = 1; NaN without friction
  double begin_velocity_m_per_s;  ///< sliding
  double end_velocity_m_per_s;
  double drive_amplitude_N;  ///< in force during it
  double target;             ///< that its drive was picked for; NaN in open loop
  control::State state;      ///< of the command in force during it
  control::Limit limit;      ///< likewise
};

struct FaultEvent {
  double time_s;
  control::Fault fault;
};

/// What only a closed loop has.
struct ControlRecord {
  scene::ControlDesign design;
  std::uint64_t trace_hash = 0;  ///< FNV-1a over every drive command, bit for bit
  std::uint64_t commands = 0;
  std::uint64_t saturated_commands = 0;  ///< at the actuator's limit
  std::vector<FaultEvent> faults;
  std::vector<numeric::SignalRecord> signals;  ///< fixed point only
};

struct RunResult {
  PlantState final_state{};
  double final_time_s = 0.0;
  std::uint64_t solver_steps = 0;
  std::uint64_t solver_events = 0;
  double wall_s = 0.0;
  EnergyBalance whole;
  EnergyBalance window;
  std::vector<Period> periods;
  Recording trace;                   ///< as the scene asks
  std::vector<Recording> close_ups;  ///< a few carrier periods at each of the first target steps
  Recording ending;                  ///< the last carrier periods, for loops and spectra
  std::optional<ControlRecord> control;
};

}  // namespace sonoglide::loop
