/// What a simulated run comes to.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "firmware/control/drive_command.hpp"
#include "firmware/numeric/signal_ledger.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/loop/energy.hpp"
#include "host_sim/loop/image_record.hpp"
#include "host_sim/loop/plant_port.hpp"
#include "host_sim/loop/steady_orbit.hpp"

namespace sonoglide::loop {

struct FaultEvent {
  double time_s;
  control::Fault fault;
};

/// What only a closed loop has.
struct ControlRecord {
  configure::ControlDesign design;
  std::uint64_t trace_hash = 0;  ///< FNV-1a over every drive command, bit for bit
  std::uint64_t commands = 0;
  std::uint64_t saturated_commands = 0;        ///< at the actuator's limit
  std::vector<FaultEvent> faults;              ///< a fault lasts: few
  std::vector<numeric::SignalRecord> signals;  ///< fixed point only
};

/// As large after an hour as after a millisecond; what has a course is for a Watch.
struct RunResult {
  PlantState final_state{};
  double final_time_s = 0.0;
  std::uint64_t solver_steps = 0;
  std::uint64_t solver_events = 0;
  double wall_s = 0.0;
  EnergyBalance whole;
  EnergyBalance window;
  std::optional<SteadyOrbit> steady_orbit;  ///< where the run began on it
  std::optional<ControlRecord> control;
  std::optional<ImageRecord> image;  ///< whoever made the image fills it in
};

}  // namespace sonoglide::loop
