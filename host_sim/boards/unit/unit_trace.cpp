#include "host_sim/boards/unit/unit_trace.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <iterator>

#include "host_sim/boards/unit/stream_table.hpp"
#include "host_sim/process/pipe.hpp"

namespace sonoglide::unit {
namespace {

constexpr auto bit(link::Trigger trigger) {
  return static_cast<std::uint8_t>(trigger);
}

std::string names_of(std::uint8_t triggers) {
  std::vector<const char*> words;
  if ((triggers & bit(link::Trigger::now)) != 0) {
    words.push_back("now");
  }
  if ((triggers & bit(link::Trigger::fault)) != 0) {
    words.push_back("fault");
  }
  if ((triggers & bit(link::Trigger::target)) != 0) {
    words.push_back("target");
  }
  return fmt::format("{}", fmt::join(words, ", "));
}

std::optional<std::uint16_t> count_of(const std::string& word) {
  std::uint16_t count = 0;
  const char* const end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data(), end, count);
  return error == std::errc() && rest == end ? std::optional(count) : std::nullopt;
}

std::string row_of(std::uint32_t period, const link::TraceRecord& record, link::TraceExtra extra,
                   const UnitScales& scales) {
  const auto text = [&](link::Quantity quantity, std::int32_t code) {
    return scales.text_of(quantity, static_cast<std::uint32_t>(code));
  };
  std::string row = fmt::format("{},{},{},{},{},{}", period,
                                text(link::Quantity::friction_force, record.friction_force),
                                text(link::Quantity::sliding_velocity, record.sliding_velocity),
                                text(link::Quantity::amplitude, record.amplitude),
                                scales.target_of(record.target), text_of_codes(record.codes));
  if (extra == link::TraceExtra::bias) {
    row += "," + text(link::Quantity::bias, record.other);
  } else if (extra == link::TraceExtra::frequency) {
    row += fmt::format(",{}", record.other);
  }
  return row;
}

std::string column_of(link::TraceExtra extra, const UnitScales& scales) {
  switch (extra) {
    case link::TraceExtra::bias:
      return "," + scales.column_of(link::Quantity::bias);
    case link::TraceExtra::frequency:
      return ",frequency_steps";
    case link::TraceExtra::none:
      break;
  }
  return "";
}

}  // namespace

std::optional<link::ArmTrace> trace_of(const std::vector<std::string>& words,
                                       std::uint16_t usual_before) {
  link::ArmTrace trace{0, usual_before};
  if (words == std::vector<std::string>{"now"}) {
    trace.triggers = bit(link::Trigger::now);
    return trace;
  }
  if (words.empty() || words[0] != "on") {
    return std::nullopt;
  }
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (words[i] == "fault") {
      trace.triggers |= bit(link::Trigger::fault);
    } else if (words[i] == "target") {
      trace.triggers |= bit(link::Trigger::target);
    } else if (const auto before = count_of(words[i]); before && i + 1 == words.size()) {
      trace.before = *before;
    } else {
      return std::nullopt;
    }
  }
  return trace.triggers == 0 ? std::nullopt : std::optional(trace);
}

std::string text_of(const link::TraceState& state) {
  switch (static_cast<link::TracePhase>(state.phase)) {
    case link::TracePhase::waiting:
      return "trace waiting";
    case link::TracePhase::recording:
      return "trace recording, triggered by " + names_of(state.cause);
    case link::TracePhase::whole:
      return fmt::format("trace of {} steps from period {}, triggered by {} in period {}",
                         state.records, state.first_period, names_of(state.cause),
                         state.first_period + state.before);
    case link::TracePhase::empty:
      break;
  }
  return "no trace";
}

RecordedTrace read_trace(UnitLink& unit, const link::TraceState& state) {
  RecordedTrace trace{state, {}};
  for (std::uint16_t i = 0; i < state.records; ++i) {
    const auto result = unit.ask<link::TraceRecord>(link::ReadTraceRecord{i});
    const auto* const record = std::get_if<link::TraceRecord>(&result);
    if (record == nullptr) {
      throw process::ProcessError("another host armed the trace");
    }
    trace.records.push_back(*record);
  }
  return trace;
}

namespace {

template <class ValueOf>
std::vector<double> each(const RecordedTrace& trace, const ValueOf& value_of) {
  std::vector<double> all;
  std::transform(trace.records.begin(), trace.records.end(), std::back_inserter(all), value_of);
  return all;
}

}  // namespace

std::vector<double> times_of(const RecordedTrace& trace, const UnitScales& scales) {
  return each(trace, [&](const link::TraceRecord& record) {
    return (record.index - trace.state.before) * scales.step_s();
  });
}

std::vector<double> values_of(const RecordedTrace& trace, const UnitScales& scales,
                              link::Quantity quantity, std::int32_t link::TraceRecord::*code) {
  return each(trace, [&](const link::TraceRecord& record) {
    return scales.value_of(quantity, static_cast<std::uint32_t>(record.*code));
  });
}

std::vector<double> targets_of(const RecordedTrace& trace, const UnitScales& scales) {
  return each(trace,
              [&](const link::TraceRecord& record) { return scales.target_of(record.target); });
}

std::string csv_of(const RecordedTrace& trace, const UnitScales& scales) {
  const auto extra = static_cast<link::TraceExtra>(trace.state.extra);
  std::string table =
      fmt::format("period,{},{},{},{},state,limit,fault,settling{}\n",
                  scales.column_of(link::Quantity::friction_force),
                  scales.column_of(link::Quantity::sliding_velocity),
                  scales.column_of(link::Quantity::amplitude),
                  scales.column_of(link::Quantity::target), column_of(extra, scales));
  std::uint32_t period = trace.state.first_period;
  for (const link::TraceRecord& record : trace.records) {
    table += row_of(period++, record, extra, scales) + "\n";
  }
  return table;
}

}  // namespace sonoglide::unit
