#include "host_sim/unit/console.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <system_error>

#include "firmware/app/parameter_labels.hpp"
#include "firmware/app/unit_names.hpp"
#include "firmware/encoding/decimal.hpp"
#include "host_sim/process/pipe.hpp"
#include "host_sim/process/printable.hpp"
#include "host_sim/process/scratch_folder.hpp"
#include "host_sim/unit/unit_trace.hpp"
#include "host_sim/unit/unit_words.hpp"

namespace sonoglide::unit {
namespace {

using app::parameter_labels;

constexpr const char* help_text =
    "identity, status, target NUMBER, stop, restart, confirm, log, params, params NAME, set NAME VALUE, "
    "stream CHANNEL ... [every N], stream off, "
    "trace, trace now, trace on fault|target [STEPS_BEFORE], trace save FILE";

bool read_value(const std::string& text, int places, std::uint32_t& value) {
  return encoding::read_decimal(text.data(), text.size(), places, value);
}

std::string text_of(const link::ParameterValue& value) {
  const app::ParameterLabel& label = parameter_labels[value.parameter];
  const auto number = [&](std::uint32_t count) { return decimal(count, value.decimal_places); };
  return fmt::format("{} {}, compiled in {}; allowed is {} to {}{}", label.name,
                     number(value.value), number(value.preset), number(value.lowest),
                     number(value.highest), label.unit);
}

std::string text_of(const link::Telemetry& told) {
  std::string text = fmt::format("state {}, target {}, drive {}, limit {}",
                                 control::name(static_cast<control::State>(told.state)),
                                 decimal(told.target, 6), millionths_of_code(told.amplitude),
                                 control::name(static_cast<control::Limit>(told.limit)));
  if (const auto settling = static_cast<control::Settling>(told.settling);
      settling != control::Settling::pending) {
    text += fmt::format(", {}", control::name(settling));
  }
  if (told.mismatch > 0) {
    text += ", nominal/true friction " + decimal(told.mismatch, 3);
  }
  text += fmt::format(", fault {}, parameters {}, period {}", app::fault_name(told.fault),
                      app::name(static_cast<store::Origin>(told.parameters)), told.period);
  if (told.lost_frames > 0) {
    text += fmt::format(", frames lost {}", told.lost_frames);
  }
  return text;
}

std::string text_of(const link::Identity& told) {
  const std::string board = board_of(told);
  return fmt::format("{}firmware {}.{}.{}, design {:#010x}, serial number {}",
                     board.empty() ? "" : process::printable(board) + ", ", told.major_number,
                     told.minor_number, told.patch_number, told.design,
                     told.serial_number == 0 ? "none" : std::to_string(told.serial_number));
}

/// A file that appears whole or not at all.
bool write_whole(const std::filesystem::path& file, const std::string& content) try {
  const process::ScratchFolder folder(file.has_parent_path() ? file.parent_path() : ".");
  const std::filesystem::path staged = folder.path() / "trace.csv";
  std::ofstream stream(staged);
  stream << content;
  stream.close();
  std::error_code error;
  if (stream) {
    std::filesystem::rename(staged, file, error);
  }
  return stream && !error;
} catch (const process::ScratchError&) {
  return false;
}

}  // namespace

std::vector<std::string> Console::carry_out(const std::string& line) {
  std::istringstream text(line);
  std::vector<std::string> words;
  for (std::string word; text >> word;) {
    words.push_back(word);
  }
  const std::string command = words.empty() ? "" : words[0];
  if (command == "stream") {
    return stream({words.begin() + 1, words.end()});
  }
  if (command == "trace") {
    return trace({words.begin() + 1, words.end()});
  }
  switch (words.size()) {
    case 0:
      return {};
    case 1:
      if (command == "identity") {
        return {identity()};
      }
      if (command == "status") {
        return status();
      }
      if (command == "stop") {
        return stop();
      }
      if (command == "restart") {
        return restart();
      }
      if (command == "confirm") {
        return confirm();
      }
      if (command == "log") {
        return log();
      }
      if (command == "params") {
        return list_parameters();
      }
      if (command == "help") {
        return {help_text};
      }
      break;
    case 2:
      if (command == "target") {
        return set_target(words[1]);
      }
      if (command == "params") {
        return list_parameter(words[1]);
      }
      break;
    case 3:
      if (command == "set") {
        return set_parameter(words[1], words[2]);
      }
      break;
    default:
      break;
  }
  return refuse(fmt::format("unknown; there are: {}", help_text));
}

std::string Console::identity() {
  const auto result = unit_.ask<link::Identity>(link::ReadIdentity{});
  if (const auto* refusal = std::get_if<link::Refusal>(&result)) {
    return refuse(*refusal, 0).front();
  }
  return text_of(std::get<link::Identity>(result));
}

std::string Console::tell_news() {
  const link::Telemetry told = telemetry();
  const bool is_new = told.fault != 0 && told.fault != told_fault_;
  told_fault_ = told.fault;
  return is_new ? fmt::format("fault {}", app::fault_name(told.fault)) : "";
}

Console::Lines Console::take_rows() {
  Lines rows;
  for (const link::Streamed& sample : unit_.take_streamed()) {
    rows.push_back(table_.row(sample));
  }
  return rows;
}

Console::Lines Console::status() {
  const link::Telemetry told = telemetry();
  told_fault_ = told.fault;
  return {text_of(told)};
}

Console::Lines Console::set_target(const std::string& text) {
  constexpr auto target = static_cast<std::size_t>(app::Parameter::target);
  std::uint32_t ratio = 0;
  if (!read_value(text, parameter_labels[target].decimal_places, ratio)) {
    ratio = UINT32_MAX;  // the unit names its range
  }
  const auto result = unit_.ask<link::TargetSet>(link::SetTarget{ratio});
  if (const auto* refusal = std::get_if<link::Refusal>(&result)) {
    return refuse(*refusal, target);
  }
  return status();
}

Console::Lines Console::stop() {
  unit_.ask<link::Stopped>(link::Stop{});
  return status();
}

Console::Lines Console::restart() {
  const auto result = unit_.ask<link::Restarted>(link::Restart{});
  if (const auto* refusal = std::get_if<link::Refusal>(&result)) {
    return refuse(*refusal, 0);
  }
  return status();
}

Console::Lines Console::confirm() {
  const auto result = unit_.ask<link::Confirmed>(link::Confirm{}, longest_save);
  if (const auto* refusal = std::get_if<link::Refusal>(&result)) {
    if (refusal->reason == static_cast<std::uint8_t>(link::Reason::not_saved)) {
      return {"parameters confirmed until reset; not saved"};
    }
    return refuse(*refusal, 0);
  }
  return {"parameters confirmed, saved"};
}

Console::Lines Console::log() {
  Lines lines;
  std::uint32_t count = 0;
  for (std::uint8_t age = 0; age < UINT8_MAX; ++age) {
    const auto result = unit_.ask<link::LoggedFault>(link::ReadFault{age});
    const auto* fault = std::get_if<link::LoggedFault>(&result);
    if (fault == nullptr) {
      break;
    }
    lines.push_back(fmt::format("period {}: {}", fault->period, app::fault_name(fault->fault)));
    count = fault->count;
  }
  lines.push_back(fmt::format("faults since reset: {}", count));
  return lines;
}

Console::Lines Console::list_parameters() {
  Lines lines;
  for (const app::ParameterLabel& label : parameter_labels) {
    const Lines line = list_parameter(label.name);
    lines.insert(lines.end(), line.begin(), line.end());
  }
  return lines;
}

Console::Lines Console::list_parameter(const std::string& name) {
  const std::size_t parameter = parameter_named(name);
  const auto result =
      unit_.ask<link::ParameterValue>(link::ReadParameter{static_cast<std::uint8_t>(parameter)});
  if (const auto* refusal = std::get_if<link::Refusal>(&result)) {
    return refuse(*refusal, parameter);
  }
  return {text_of(std::get<link::ParameterValue>(result))};
}

Console::Lines Console::set_parameter(const std::string& name, const std::string& text) {
  const std::size_t parameter = parameter_named(name);
  std::uint32_t value = UINT32_MAX;  // the unit names its range
  if (parameter < app::parameter_count) {
    read_value(text, parameter_labels[parameter].decimal_places, value);
  }
  link::WriteParameter request{};
  request.parameter = static_cast<std::uint8_t>(parameter);
  request.value = value;
  const auto result = unit_.ask<link::ParameterWritten>(request, longest_save);
  if (const auto* refusal = std::get_if<link::Refusal>(&result)) {
    return refuse(*refusal, parameter);
  }
  return {fmt::format("{} {}, saved", name,
                      decimal(std::get<link::ParameterWritten>(result).value,
                              parameter_labels[parameter].decimal_places))};
}

Console::Lines Console::stream(const std::vector<std::string>& words) {
  const std::optional<link::Stream> wanted = stream_of(words);
  if (!wanted) {
    return refuse(
        fmt::format("stream CHANNEL ... [every N], or stream off; channels: {}; N: 1 to 65535",
                    channel_names()));
  }
  // That of before ends first, so that its samples are not taken for those of the next.
  const auto ended = unit_.ask<link::Streaming>(link::Stream{0, 1});
  if (const auto* refusal = std::get_if<link::Refusal>(&ended)) {
    return refuse(*refusal, 0);
  }
  Lines lines = take_rows();
  if (wanted->channels == 0) {
    lines.push_back(fmt::format("stream off, samples lost: {}", table_.lost()));
  } else {
    const auto begun = unit_.ask<link::Streaming>(*wanted);
    if (const auto* refusal = std::get_if<link::Refusal>(&begun)) {
      return refuse(*refusal, 0);
    }
    lines.push_back(table_.begin(*wanted));
  }
  return lines;
}

Console::Lines Console::trace(const std::vector<std::string>& words) {
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
    return refuse(
        fmt::format("trace, trace now, trace on fault|target [STEPS_BEFORE], or trace save FILE; "
                    "STEPS_BEFORE: 0 to {}",
                    state->records - 1));
  }
  const auto armed = unit_.ask<link::TraceArmed>(*wanted);
  if (const auto* refusal = std::get_if<link::Refusal>(&armed)) {
    return refuse(*refusal, 0);
  }
  return {"trace waiting"};
}

Console::Lines Console::save_trace(const link::TraceState& state, const std::string& file) {
  if (static_cast<link::TracePhase>(state.phase) != link::TracePhase::whole) {
    return refuse(text_of(state) + ": nothing to save");
  }
  std::error_code error;
  if (std::filesystem::exists(file, error)) {
    return refuse(process::printable(file) + ": is there already");
  }
  if (!write_whole(file, read_trace(unit_, state))) {
    return refuse(process::printable(file) + ": cannot be written");
  }
  return {fmt::format("{} steps saved", state.records)};
}

link::Telemetry Console::telemetry() {
  const auto result = unit_.ask<link::Telemetry>(link::ReadTelemetry{});
  if (const auto* refusal = std::get_if<link::Refusal>(&result)) {
    throw process::ProcessError("the unit does not tell its state: " + words_of(*refusal, 0));
  }
  return std::get<link::Telemetry>(result);
}

Console::Lines Console::refuse(const std::string& reason) {
  ++refused_;
  return {reason};
}

Console::Lines Console::refuse(const link::Refusal& refusal, std::size_t parameter) {
  return refuse(words_of(refusal, parameter));
}

}  // namespace sonoglide::unit
