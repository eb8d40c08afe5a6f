/// The commands by which a person talks to a unit.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host_sim/boards/unit/live_plot.hpp"
#include "host_sim/boards/unit/stream_table.hpp"
#include "host_sim/boards/unit/unit_link.hpp"
#include "host_sim/boards/unit/unit_refusal.hpp"
#include "host_sim/boards/unit/unit_scales.hpp"

namespace sonoglide::unit {

/// Each line is a command; what the unit answers is put in words.
class Console {
 public:
  /// @param unit    outlives this
  /// @param caveat  what a reader of its identity, traces and steps must know; empty: nothing
  /// @throws process::ProcessError  the unit does not answer, or does not tell its scales
  explicit Console(UnitLink& unit, std::string caveat = {})
      : unit_(unit), scales_(unit), caveat_(std::move(caveat)) {}

  /// Carries out a command: `help` lists them. An empty line does nothing. A word with blanks is in double quotes.
  /// @return the lines of the answer
  /// @throws process::ProcessError  the unit does not answer
  std::vector<std::string> carry_out(const std::string& line);

  /// What the unit is, and in what it tells and takes its numbers.
  /// @throws process::ProcessError  the unit does not answer
  std::vector<std::string> identity();

  /// A sign of life to the unit.
  /// @return a line on each new fault that it finds, else nothing
  /// @throws process::ProcessError  the unit does not answer
  std::string tell_news();

  /// The rows of the stream that have come since the last call.
  /// @throws process::ProcessError  the device is gone
  std::vector<std::string> take_rows();

  /// Commands that were refused, here or by the unit.
  std::size_t refused() const { return refused_; }

 private:
  using Lines = std::vector<std::string>;
  using Words = std::vector<std::string>;
  struct Command;
  static const std::vector<Command>& commands();
  static Lines help();
  /// Of all commands.
  static std::string names();

  Lines status();
  Lines set_target(const Words& words);
  Lines stop();
  Lines restart();
  Lines confirm();
  Lines log();
  Lines history();
  Lines list_parameters();
  Lines list_parameter(const std::string& name);
  Lines set_parameter(const Words& words);
  Lines tare();

  Lines stream(const Words& words);
  Lines plot(const std::string& channel);
  Lines begin_stream(const link::Stream& wanted, const std::optional<LivePlot>& plot);
  Lines trace(const Words& words);
  Lines save_trace(const link::TraceState& state, const std::string& file);
  Lines step(const Words& words);
  Lines with_caveat(const std::string& answer) const;

  /// As unit::require().
  template <class Answer, class Request>
  Answer require(const Request& request, std::size_t parameter = 0,
                 std::chrono::milliseconds work = {}) {
    return unit::require<Answer>(unit_, scales_, request, parameter, work);
  }
  link::Telemetry telemetry();
  /// Of a command with other words than it takes.
  Lines refuse_usage(const std::string& name, const Words& words, const std::string& ranges = "");
  /// Of a target, as the unit has it: "friction force, 0 to 0.04 N".
  std::string allowed_target();
  /// "0 to 1".
  std::string allowed_range(std::size_t parameter);
  /// "; VALUE: a number alone, -0.01 to 0.01 N": behind a usage.
  std::string allowed_value(const std::string& name);
  /// Of a text that is no value of a parameter.
  Lines refuse_value(std::size_t parameter, const std::string& reason);
  Lines refuse(const std::string& reason);

  UnitLink& unit_;
  UnitScales scales_;
  std::string caveat_;
  StreamTable table_{scales_};
  std::optional<LivePlot> plot_;  ///< of the stream that runs, in place of its table
  std::size_t refused_ = 0;
  unsigned told_fault_ = 0;
};

}  // namespace sonoglide::unit
