/// The traces by which the plant of a unit is identified.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "host_sim/boards/unit/unit_link.hpp"
#include "host_sim/boards/unit/unit_trace.hpp"

namespace sonoglide::unit {

/// Whether a unit is that of a controller: the number that it tells is that of the controller's design with
/// its parameters, as it lists them.
/// @param controller  as emulated::design_number() has it
/// @throws process::ProcessError  the unit does not answer
bool has_design(UnitLink& unit, std::uint32_t controller);

/// Stops the unit and records it without a drive, then starts it and records its step to each target but the
/// first, once it has settled at the one before. At the end, whatever happens and where a
/// signal ends the program, the unit is stopped. Its target is then that of before, but after a signal. It keeps its
/// limits and finds its faults as ever.
///
/// @param targets   more than one; friction ratios, or newtons
/// @param progress  is told the part done
/// @return          the undriven one first
/// @throws process::ProcessError  the unit does not answer, refuses, has no trace or finds a fault
std::vector<RecordedTrace> record_plant(UnitLink& unit, const std::vector<double>& targets,
                                        const std::function<void(double)>& progress);

}  // namespace sonoglide::unit
