/// The trace of a unit: how it is asked for, and its table.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "firmware/link/trace_messages.hpp"
#include "host_sim/boards/unit/unit_link.hpp"
#include "host_sim/boards/unit/unit_scales.hpp"

namespace sonoglide::unit {

/// The trace that a line of words asks for: `now`, or `on`, then `fault`, `target` or both, then how many
/// steps before it are to be kept.
/// @param usual_before  where the words do not say
/// @return nothing where they are none of these
std::optional<link::ArmTrace> trace_of(const std::vector<std::string>& words,
                                       std::uint16_t usual_before);

/// Where it stands, in words.
std::string text_of(const link::TraceState& state);

/// A trace that was read.
struct RecordedTrace {
  link::TraceState state;
  std::vector<link::TraceRecord> records;
};

/// @param state  of the unit, whole
/// @throws process::ProcessError  the unit does not answer, or another host armed it anew
RecordedTrace read_trace(UnitLink& unit, const link::TraceState& state);

/// [s] since the step that triggered it.
std::vector<double> times_of(const RecordedTrace& trace, const UnitScales& scales);

/// @param code  of a record, of full scale 2^31
std::vector<double> values_of(const RecordedTrace& trace, const UnitScales& scales,
                              link::Quantity quantity, std::int32_t link::TraceRecord::*code);

/// Friction ratios, or newtons.
std::vector<double> targets_of(const RecordedTrace& trace, const UnitScales& scales);

/// A row for each step, oldest first, with the names of the columns above them, which are those of periods.csv
/// where both have the same.
std::string csv_of(const RecordedTrace& trace, const UnitScales& scales);

}  // namespace sonoglide::unit
