#include "host_sim/boards/unit/console.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <iomanip>
#include <sstream>

#include "firmware/app/parameter_labels.hpp"
#include "firmware/app/unit_names.hpp"
#include "host_sim/boards/unit/tare.hpp"
#include "host_sim/boards/unit/unit_words.hpp"
#include "host_sim/process/file_error.hpp"

namespace sonoglide::unit {
namespace {

using app::parameter_labels;

/// A line, without blanks that say nothing.
std::string shown(const std::string& name, const std::vector<std::string>& words) {
  return words.empty() ? name : fmt::format("{} {}", name, fmt::join(words, " "));
}

}  // namespace

/// What a line may begin with, and what carries it out.
struct Console::Command {
  const char* name;
  const char* usage;  ///< every form of it
  const char* effect;
  std::size_t fewest_words;
  std::size_t most_words;  ///< behind the name
  Lines (*carry_out)(Console&, const Words&);
};

const std::vector<Console::Command>& Console::commands() {
  static const std::vector<Command> all = {
      {"identity", "identity", "board, firmware, design and full scales", 0, 0,
       [](Console& on, const Words&) { return on.identity(); }},
      {"status", "status", "state, target, drive, limit and fault", 0, 0,
       [](Console& on, const Words&) { return on.status(); }},
      {"target", "target NUMBER", "sets the target until reset", 0, SIZE_MAX,
       [](Console& on, const Words& words) { return on.set_target(words); }},
      {"stop", "stop", "drive to zero at once", 0, 0,
       [](Console& on, const Words&) { return on.stop(); }},
      {"restart", "restart", "starts the drive, from a stop, a fault or running", 0, 0,
       [](Console& on, const Words&) { return on.restart(); }},
      {"confirm", "confirm", "accepts the parameters in force, and saves them", 0, 0,
       [](Console& on, const Words&) { return on.confirm(); }},
      {"log", "log", "the last faults, and an exception before the reset", 0, 0,
       [](Console& on, const Words&) { return on.log(); }},
      {"history", "history", "boots, time in operation and the last exception, over all resets", 0,
       0, [](Console& on, const Words&) { return on.history(); }},
      {"params", "params, params NAME", "values and ranges of the parameters", 0, 1,
       [](Console& on, const Words& words) {
         return words.empty() ? on.list_parameters() : on.list_parameter(words[0]);
       }},
      {"set", "set NAME VALUE", "saves a parameter; stop first", 0, SIZE_MAX,
       [](Console& on, const Words& words) { return on.set_parameter(words); }},
      {"tare", "tare", "saves what the force sensor reads as its offset; stop and lift first", 0, 0,
       [](Console& on, const Words&) { return on.tare(); }},
      {"stream", "stream CHANNEL ... [every N], stream off", "prints the channels as a table", 0,
       SIZE_MAX, [](Console& on, const Words& words) { return on.stream(words); }},
      {"plot", "plot CHANNEL", "draws a strip chart, until stream off", 1, 1,
       [](Console& on, const Words& words) { return on.plot(words[0]); }},
      {"trace", "trace, trace now, trace on fault|target [STEPS_BEFORE], trace save FILE",
       "records each step of the controller around an event", 0, SIZE_MAX,
       [](Console& on, const Words& words) { return on.trace(words); }},
      {"step", "step FROM TO [FILE]", "goes from one target to another, and measures the force", 2,
       3, [](Console& on, const Words& words) { return on.step(words); }},
      {"help", "help", "this list", 0, 0, [](Console&, const Words&) { return help(); }},
  };
  return all;
}

Console::Lines Console::help() {
  Lines lines;
  for (const Command& command : commands()) {
    lines.push_back(fmt::format("{}: {}", command.usage, command.effect));
  }
  return lines;
}

std::string Console::names() {
  std::vector<const char*> names;
  for (const Command& command : commands()) {
    names.push_back(command.name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

std::vector<std::string> Console::carry_out(const std::string& line) {
  std::istringstream text(line);
  Words words;
  while (!(text >> std::ws).eof()) {
    std::string word;
    if (!(text >> std::quoted(word))) {
      return refuse(fmt::format("{}: a quotation mark is not closed", line));
    }
    words.push_back(word);
  }
  if (words.empty()) {
    return {};
  }
  const std::string name = words.front();
  words.erase(words.begin());
  const auto& all = commands();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Command& each) { return each.name == name; });
  if (found == all.end()) {
    return refuse(fmt::format("\"{}\": unknown; there are: {}", shown(name, words), names()));
  }
  if (words.size() < found->fewest_words || words.size() > found->most_words) {
    return refuse_usage(name, words);
  }
  try {
    return found->carry_out(*this, words);
  } catch (const UnitRefusal& refusal) {
    return refuse(refusal.what());
  } catch (const process::FileError& error) {
    return refuse(error.what());
  }
}

std::vector<std::string> Console::identity() {
  Lines lines{text_of(require<link::Identity>(link::ReadIdentity{}))};
  for (std::string& line :
       with_caveat(fmt::format("target: {}; {}", allowed_target(), text_of(scales_)))) {
    lines.push_back(std::move(line));
  }
  return lines;
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
    const std::string row = table_.row(sample);
    rows.push_back(plot_ ? plot_->row(sample) : row);
  }
  return rows;
}

Console::Lines Console::status() {
  const link::Telemetry told = telemetry();
  told_fault_ = told.fault;
  return {text_of(told, scales_)};
}

Console::Lines Console::set_target(const Words& words) {
  constexpr std::size_t target = target_parameter;
  if (words.size() != 1) {
    return refuse_usage("target", words, "; NUMBER: " + allowed_target());
  }
  const ReadValue value = read_value(words[0], target, scales_);
  if (!value.error.empty()) {
    return refuse_value(target, value.error);
  }
  require<link::TargetSet>(link::SetTarget{value.count}, target);
  return status();
}

Console::Lines Console::stop() {
  unit_.ask<link::Stopped>(link::Stop{});
  return status();
}

Console::Lines Console::restart() {
  require<link::Restarted>(link::Restart{});
  return status();
}

Console::Lines Console::confirm() try {
  require<link::Confirmed>(link::Confirm{}, 0, longest_save);
  return {"parameters confirmed, saved"};
} catch (const UnitRefusal& refusal) {
  if (refusal.has_reason(link::Reason::not_saved)) {
    return {"parameters confirmed until reset; not saved"};
  }
  throw;
}

Console::Lines Console::log() {
  Lines lines;
  std::uint32_t count = 0;
  for (std::uint8_t age = 0; age < UINT8_MAX; ++age) {
    const auto fault = ask_if_kept<link::LoggedFault>(unit_, scales_, link::ReadFault{age});
    if (!fault) {
      break;
    }
    lines.push_back(fmt::format("period {}: {}", fault->period, app::fault_name(fault->fault)));
    count = fault->count;
  }
  lines.push_back(fmt::format("faults since reset: {}", count));
  const auto history = ask_if_kept<link::History>(unit_, scales_, link::ReadHistory{});
  const auto kept = ask_if_kept<link::KeptException>(unit_, scales_, link::ReadException{});
  if (kept && (!history || history->exception_boot == history->boots)) {
    lines.push_back(text_of(*kept, "the reset"));
  }
  return lines;
}

Console::Lines Console::history() {
  const auto history = ask_if_kept<link::History>(unit_, scales_, link::ReadHistory{});
  if (!history) {
    return refuse("the unit keeps no history");
  }
  Lines lines{text_of(*history)};
  if (const auto kept = ask_if_kept<link::KeptException>(unit_, scales_, link::ReadException{})) {
    lines.push_back(text_of(*kept, fmt::format("boot {}", history->exception_boot)));
  }
  return lines;
}

/// Each by itself: a unit of another firmware may not have them all.
Console::Lines Console::list_parameters() {
  Lines lines;
  for (const app::ParameterLabel& label : parameter_labels) {
    const Lines line = carry_out(fmt::format("params {}", label.name));
    lines.insert(lines.end(), line.begin(), line.end());
  }
  return lines;
}

Console::Lines Console::list_parameter(const std::string& name) {
  const std::size_t parameter = parameter_named(name);
  return {text_of(require<link::ParameterValue>(
                      link::ReadParameter{static_cast<std::uint8_t>(parameter)}, parameter),
                  scales_)};
}

Console::Lines Console::set_parameter(const Words& words) {
  if (words.size() != 2) {
    return refuse_usage("set", words, words.empty() ? "" : allowed_value(words.front()));
  }
  const std::string& name = words[0];
  const std::string& text = words[1];
  const std::size_t parameter = parameter_named(name);
  link::WriteParameter request{};
  request.parameter = static_cast<std::uint8_t>(parameter);
  if (parameter < app::parameter_count) {
    const ReadValue value = read_value(text, parameter, scales_);
    if (!value.error.empty()) {
      return refuse_value(parameter, value.error);
    }
    request.value = value.count;
  }
  const auto written = require<link::ParameterWritten>(request, parameter, longest_save);
  return {fmt::format("{} {}{}, saved", name, scales_.text_of_parameter(parameter, written.value),
                      scales_.unit_of_parameter(parameter))};
}

Console::Lines Console::tare() {
  return text_of(unit::tare(unit_, scales_), scales_);
}

link::Telemetry Console::telemetry() {
  return require<link::Telemetry>(link::ReadTelemetry{});
}

Console::Lines Console::refuse_usage(const std::string& name, const Words& words,
                                     const std::string& ranges) {
  const auto& all = commands();
  const auto command =
      std::find_if(all.begin(), all.end(), [&](const Command& each) { return each.name == name; });
  return refuse(fmt::format("\"{}\": allowed: {}{}", shown(name, words), command->usage, ranges));
}

std::string Console::allowed_target() {
  return fmt::format("friction {}, {}", scales_.holds_force() ? "force" : "ratio",
                     allowed_range(target_parameter));
}

std::string Console::allowed_range(std::size_t parameter) {
  const auto result =
      unit_.ask<link::ParameterValue>(link::ReadParameter{static_cast<std::uint8_t>(parameter)});
  const auto* const told = std::get_if<link::ParameterValue>(&result);
  return told == nullptr ? "what the unit does not tell" : range_of(*told, scales_);
}

std::string Console::allowed_value(const std::string& name) {
  const std::size_t parameter = parameter_named(name);
  return parameter == app::parameter_count
             ? "; params lists the names"
             : fmt::format("; VALUE: a number alone, {}", allowed_range(parameter));
}

Console::Lines Console::refuse_value(std::size_t parameter, const std::string& reason) {
  return refuse(fmt::format("{}: {}; allowed is {}", parameter_labels[parameter].name, reason,
                            allowed_range(parameter)));
}

Console::Lines Console::refuse(const std::string& reason) {
  ++refused_;
  return {reason};
}

}  // namespace sonoglide::unit
