/// The trace of a unit: how it is asked for, and its table.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "firmware/link/trace_messages.hpp"
#include "host_sim/unit/unit_link.hpp"
#include "host_sim/unit/unit_scales.hpp"

namespace sonoglide::unit {

/// The trace that a line of words asks for: `now`, or `on`, then `fault`, `target` or both, then how many
/// steps before it are to be kept.
/// @param usual_before  where the words do not say
/// @return nothing where they are none of these
std::optional<link::ArmTrace> trace_of(const std::vector<std::string>& words,
                                       std::uint16_t usual_before);

/// Where it stands, in words.
std::string text_of(const link::TraceState& state);

/// @param state  of the unit, whole
/// @throws process::ProcessError  the unit does not answer, or another host armed it anew
std::vector<link::TraceRecord> read_records(UnitLink& unit, const link::TraceState& state);

/// Writes a whole trace as CSV: a row for each step, oldest first, with the names of the columns above them,
/// which are those of periods.csv where both have the same.
/// @param file  a new one; where it cannot be written is known before the trace is read
/// @throws process::ProcessError  as read_records()
/// @throws process::FileError     the file is there, or the file system refuses
void save_trace(UnitLink& unit, const UnitScales& scales, const link::TraceState& state,
                const std::string& file);

}  // namespace sonoglide::unit
