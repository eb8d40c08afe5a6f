#include "host_sim/studies/identify/impedance/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "host_sim/studies/identify/impedance/sweep_columns.hpp"
#include "host_sim/studies/identify/text_file.hpp"

namespace sonoglide::identify::impedance {
namespace {

using scene_file::SceneError;

constexpr std::string_view between_names = "-/, ";

/// What stands behind a colon in a line as `"FORMAT: |Z|"`; nothing where there is none.
struct Setting {
  std::string text;
  std::size_t line = 0;
  std::size_t column = 1;
};

struct Trace {
  Setting format;
  FoundTable table;
};

SweepColumns columns_of(std::string_view one, std::string_view other) {
  SweepColumns columns{read_name(one), read_name(other)};
  columns.first.index = 1;
  columns.second->index = 1;
  return columns;
}

/// The pair of two names; a phase whose unit is not named is in degrees, as the instrument has it.
std::optional<SweepColumns> pair_of(std::string_view one, std::string_view other) {
  SweepColumns pair = columns_of(one, other);
  const bool is_polar = pair.first.role == Role::magnitude && pair.second->role == Role::phase;
  if (is_polar && !pair.second->has_unit) {
    pair.second->scale *= read_name("phase (deg)").scale;
    pair.second->has_unit = true;
  }
  const bool is_pair = is_polar || (pair.rectangular() && pair.second->role == Role::imaginary);
  return is_pair ? std::optional(pair) : std::nullopt;
}

/// That of a text, as `R-X` or `ADMITTANCE MAG PHASE (DEG)`.
std::optional<SweepColumns> pair_of(const std::string& text) {
  for (std::size_t i = 1; i + 1 < text.size(); ++i) {
    const bool parts = between_names.find(text[i]) != std::string_view::npos;
    if (auto pair = parts ? pair_of(text.substr(0, i), text.substr(i + 1)) : std::nullopt) {
      return pair;
    }
  }
  return std::nullopt;
}

class TraceReader {
 public:
  explicit TraceReader(const scene_file::Source& source) : source_(source) {
    bool in_rows = false;
    for (const Line& line : lines_of(source)) {
      const bool is_row = in_rows && line.text.find('"') == std::string_view::npos;
      if (line.text.find("TRACE:") != std::string_view::npos) {
        traces_.emplace_back();
        in_rows = false;
      } else if (is_row) {
        traces_.back().table.rows.push_back(line);
      } else if (traces_.empty()) {
        take_setting(line, "PARAMETER:", parameter_);
      } else if (line.text.find("Frequency") != std::string_view::npos) {
        traces_.back().table.heading = heading_of(line, 2);
        in_rows = true;
      } else {
        take_setting(line, "FORMAT:", traces_.back().format);
      }
    }
    const auto has_no_rows = [](const Trace& each) { return each.table.rows.empty(); };
    traces_.erase(std::remove_if(traces_.begin(), traces_.end(), has_no_rows), traces_.end());
    if (traces_.empty()) {
      throw SceneError({source.file, 1, 1}, "trace",
                       "has no readings below \"Frequency\"; allowed: at least one");
    }
  }

  Sweep read() const {
    const MeasuredTable a(source_, traces_.front().table);
    const std::vector<double> imaginary =
        a.names().size() > 2 ? a.numbers(2) : std::vector<double>();
    const bool is_complex =
        std::any_of(imaginary.begin(), imaginary.end(), [](double each) { return each != 0.0; });
    const bool has_two = traces_.size() > 1 && !is_complex;
    const MeasuredTable b(source_, traces_[has_two ? 1 : 0].table);
    if (b.numbers(0) != a.numbers(0)) {
      throw SceneError({source_.file, traces_[1].table.rows.back().number, 1}, "trace",
                       "trace B has other frequencies than trace A; allowed: the same");
    }
    std::vector<std::string> warnings;
    const SweepColumns columns = is_complex ? complex_trace(warnings)
                                 : has_two  ? two_traces(warnings)
                                            : one_trace(warnings);
    Sweep sweep = sweep_of(a, b, {}, columns);
    sweep.warnings.insert(sweep.warnings.begin(), warnings.begin(), warnings.end());
    sweep.format = fmt::format("an analyser's export of {}", columns.description());
    return sweep;
  }

 private:
  /// That of a line, if it names it. LOG and LIN say how the screen shows a trace.
  static void take_setting(const Line& line, std::string_view name, Setting& setting) {
    const std::size_t at = line.text.find(name);
    if (at == std::string_view::npos) {
      return;
    }
    const std::size_t from =
        std::min(line.text.find_first_not_of(' ', at + name.size()), line.text.size());
    const std::string_view behind = line.text.substr(from);
    const std::string text(trimmed(behind.substr(0, behind.find('"'))));
    if (const std::string way = lower_case(text.substr(0, 3)); way != "log" && way != "lin") {
      setting = {text, line.number, from + 1};
    }
  }

  /// Of `COMPLEX Z-Y` the first letter counts.
  SweepColumns complex_trace(std::vector<std::string>& warnings) const {
    const Setting& named = parameter_.text.empty() ? traces_.front().format : parameter_;
    const bool says_complex = lower_case(named.text).rfind("complex", 0) == 0;
    const std::string_view text =
        trimmed(std::string_view(named.text).substr(says_complex ? 7 : 0));
    const Subject subject = read_name(text.substr(0, text.find_first_of(between_names))).subject;
    if (subject == Subject::unknown && !named.text.empty()) {
      throw error(named, "is no complex trace that is known");
    }
    if (subject == Subject::unknown) {
      warnings.emplace_back(
          "The file does not name what its complex trace is; it is taken for an impedance in ohm.");
    }
    if (traces_.size() > 1) {
      warnings.emplace_back("Trace A is complex and is read; trace B is not read.");
    }
    const bool is_admittance = subject == Subject::admittance;
    SweepColumns columns = columns_of(is_admittance ? "G" : "R", is_admittance ? "B" : "X");
    columns.second->index = 2;
    return columns;
  }

  SweepColumns two_traces(std::vector<std::string>& warnings) const {
    const Setting& a = traces_[0].format;
    const Setting& b = traces_[1].format;
    const bool by_parameter = !parameter_.text.empty();
    if (!by_parameter && a.text.empty() && b.text.empty()) {
      warnings.emplace_back(
          "The file does not name what its traces are; A is taken for |Z| in ohm, B for its phase "
          "in degrees.");
      return *pair_of("|Z|", "phase");
    }
    const auto found = by_parameter ? pair_of(parameter_.text) : pair_of(a.text, b.text);
    if (!found) {
      Setting named = by_parameter ? parameter_ : b.text.empty() ? a : b;
      named.text = by_parameter ? named.text : fmt::format("{}\" and \"{}", a.text, b.text);
      throw error(named, by_parameter ? "is no pair of traces that is known"
                                      : "are no pair of traces that is known");
    }
    return *found;
  }

  SweepColumns one_trace(std::vector<std::string>& warnings) const {
    const Setting& format = traces_.front().format;
    const Setting& named = format.text.empty() ? parameter_ : format;
    const std::string text = named.text.empty() ? "|Z|" : named.text;
    SweepColumns columns = pair_of(text).value_or(columns_of(text, ""));
    if (columns.first.role != Role::magnitude) {
      throw error(named, "alone, without trace B");
    }
    warnings.emplace_back(
        "The file has no readings of trace B: the magnitudes of A are fitted alone.");
    columns.second.reset();
    return columns;
  }

  SceneError error(const Setting& at, const char* message) const {
    return {{source_.file, at.line, at.column},
            "trace",
            fmt::format("\"{}\" {}; allowed: |Z|-theta, R-X, |Y|-theta, G-B, complex Z, complex Y",
                        at.text, message)};
  }

  const scene_file::Source& source_;
  Setting parameter_;
  std::vector<Trace> traces_;
};

}  // namespace

std::optional<Sweep> read_traces(const scene_file::Source& source) {
  const bool has_traces = source.text.find("TRACE: A\"") != std::string::npos;
  return has_traces ? std::optional(TraceReader(source).read()) : std::nullopt;
}

}  // namespace sonoglide::identify::impedance
