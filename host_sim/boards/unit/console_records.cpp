// The commands that record what a unit does: stream, trace and step.
#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "host_sim/boards/unit/console.hpp"
#include "host_sim/boards/unit/step_recorder.hpp"
#include "host_sim/boards/unit/step_response.hpp"
#include "host_sim/boards/unit/trace_file.hpp"
#include "host_sim/boards/unit/unit_trace.hpp"
#include "host_sim/boards/unit/unit_words.hpp"

namespace sonoglide::unit {

Console::Lines Console::stream(const Words& words) {
  const std::optional<link::Stream> wanted = stream_of(words);
  if (!wanted) {
    return refuse_usage("stream", words,
                        fmt::format("; channels: {}; N: 1 to 65535", channel_names()));
  }
  return begin_stream(*wanted, std::nullopt);
}

Console::Lines Console::plot(const std::string& channel) {
  const std::optional<link::Stream> named = stream_of({channel});
  const auto plot = named ? plot_of(*named, scales_) : std::nullopt;
  if (!plot) {
    return refuse_usage("plot", {channel},
                        fmt::format("; channels: {}, of them not state", channel_names()));
  }
  return begin_stream(plot->stream(), plot);
}

/// @param plot  in place of a table
Console::Lines Console::begin_stream(const link::Stream& wanted,
                                     const std::optional<LivePlot>& plot) {
  // That of before ends first, so that its samples are not taken for those of the next.
  taken<link::Streaming>(unit_.stream({0, 1}), scales_);
  Lines lines = take_rows();
  plot_.reset();
  if (wanted.channels == 0) {
    lines.push_back(fmt::format("stream off, samples lost: {}", table_.lost()));
    return lines;
  }
  taken<link::Streaming>(unit_.stream(wanted), scales_);
  const std::string columns = table_.begin(wanted);
  lines.push_back(plot ? plot->heading() : columns);
  if (plot) {
    plot_.emplace(*plot);
  }
  return lines;
}

Console::Lines Console::trace(const Words& words) {
  const auto told = unit_.ask<link::TraceState>(link::ReadTraceState{});
  const auto* const state = std::get_if<link::TraceState>(&told);
  if (state == nullptr) {
    return refuse("the unit has no trace");
  }
  if (words.empty()) {
    return {text_of(*state)};
  }
  if (words.size() == 2 && words[0] == "save") {
    return save_trace(*state, words[1]);
  }
  const auto wanted = trace_of(words, static_cast<std::uint16_t>(state->records / 2));
  if (!wanted || wanted->before >= state->records) {
    return refuse_usage("trace", words, fmt::format("; STEPS_BEFORE: 0 to {}", state->records - 1));
  }
  require<link::TraceArmed>(*wanted);
  return {"trace waiting"};
}

Console::Lines Console::save_trace(const link::TraceState& state, const std::string& file) {
  if (static_cast<link::TracePhase>(state.phase) != link::TracePhase::whole) {
    return refuse(text_of(state) + ": nothing to save");
  }
  TraceFile saved(file);
  saved.write(read_trace(unit_, state), scales_, std::nullopt, caveat_);
  return with_caveat(fmt::format("{} steps saved", state.records));
}

Console::Lines Console::with_caveat(const std::string& answer) const {
  return caveat_.empty() ? Lines{answer} : Lines{answer, caveat_};
}

Console::Lines Console::step(const Words& words) {
  if (words.size() == 3 && is_number(words[2])) {  // likely a third target
    return refuse_usage("step", words);
  }
  std::array<std::uint32_t, 2> targets{};
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const ReadValue value = read_value(words[i], target_parameter, scales_);
    if (!value.error.empty()) {
      return refuse_value(target_parameter, value.error);
    }
    targets.at(i) = value.count;
  }
  std::optional<TraceFile> file;
  if (words.size() == 3) {
    file.emplace(words[2]);
  }
  const RecordedStep step = StepRecorder(unit_, scales_).step_between(targets[0], targets[1]);
  const StepResponse response = step_response(step, scales_);
  if (file) {
    file->write(step.trace, scales_, response, caveat_);
  }
  return with_caveat(text_of(response));
}

}  // namespace sonoglide::unit
