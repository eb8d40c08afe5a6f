#include "host_sim/studies/identify/impedance/read_traces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <optional>

#include "host_sim/studies/identify/impedance/sweep_columns.hpp"
#include "host_sim/studies/identify/plain_text.hpp"

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
  Heading heading;
  std::vector<Line> rows;
};

/// How the screen shows a trace says nothing of it.
bool is_of_screen(const std::string& format) {
  const std::string small = lower_case(format);
  return small.rfind("log", 0) == 0 || small.rfind("lin", 0) == 0;
}

ColumnName name_of(Role role, Subject subject) {
  ColumnName name;
  name.role = role;
  name.subject = subject;
  name.has_unit = true;
  return name;
}

/// The pair of two names; a phase whose unit is not named is in degrees, as the instrument has it.
std::optional<SweepColumns> pair_of(const std::string& one, const std::string& other) {
  SweepColumns pair{{read_name(one), 1}, SweepColumn{read_name(other), 1}};
  const Role first = pair.first.name.role;
  ColumnName& second = pair.second->name;
  if (first == Role::magnitude && second.role == Role::phase) {
    second.scale *= second.has_unit ? 1.0 : read_name("phase (deg)").scale;
    second.has_unit = true;
    return pair;
  }
  return first == Role::real && second.role == Role::imaginary ? std::optional(pair) : std::nullopt;
}

/// That of a text, as `R-X` or `ADMITTANCE MAG PHASE (DEG)`.
std::optional<SweepColumns> pair_of(const std::string& text) {
  for (std::size_t i = 1; i + 1 < text.size(); ++i) {
    if (between_names.find(text[i]) != std::string_view::npos) {
      if (auto pair = pair_of(text.substr(0, i), text.substr(i + 1))) {
        return pair;
      }
    }
  }
  return std::nullopt;
}

class TraceReader {
 public:
  explicit TraceReader(const scene_file::Source& source) : source_(source) {
    split();
    for (const Trace& each : traces_) {
      if (!each.rows.empty()) {
        tables_.emplace_back(source, each.heading, each.rows);
      }
    }
    if (tables_.empty()) {
      throw SceneError({source.file, 1, 1}, "trace",
                       "has no readings below \"Frequency\"; allowed: at least one");
    }
  }

  Sweep read() const {
    Sweep sweep;
    const MeasuredTable& a = tables_.front();
    const bool complex = is_complex(a);
    const MeasuredTable& b = tables_.size() > 1 && !complex ? tables_[1] : a;
    sweep.frequency_Hz = frequencies_Hz(a, {name_of(Role::frequency, Subject::unknown), 0});
    if (b.numbers(0) != a.numbers(0)) {
      throw SceneError({source_.file, traces_[1].rows.back().number, 1}, "trace",
                       "trace B has other frequencies than trace A; allowed: the same");
    }
    const SweepColumns columns = complex    ? complex_trace(sweep)
                                 : &a == &b ? alone(sweep)
                                            : pair(sweep);
    sweep.has_phase = columns.second.has_value();
    sweep.admittance_S = admittances_S(a, b, columns, sweep.warnings);
    sweep.format = fmt::format("an analyser's export of {}", columns.description());
    return sweep;
  }

 private:
  void split() {
    bool in_rows = false;
    for (const Line& line : lines_of(source_)) {
      const bool is_row = in_rows && line.text.find('"') == std::string_view::npos;
      if (line.text.find("TRACE:") != std::string_view::npos) {
        traces_.emplace_back();
        in_rows = false;
      } else if (is_row) {
        traces_.back().rows.push_back(line);
      } else if (traces_.empty()) {
        take_setting(line, "PARAMETER:", parameter_);
      } else if (line.text.find("Frequency") != std::string_view::npos) {
        traces_.back().heading = identify::heading_of(line, 2).value_or(Heading());
        in_rows = true;
      } else {
        take_setting(line, "FORMAT:", traces_.back().format);
      }
    }
  }

  /// That of a line, if it names it.
  void take_setting(const Line& line, std::string_view name, Setting& setting) const {
    const std::size_t at = line.text.find(name);
    if (at == std::string_view::npos) {
      return;
    }
    const std::size_t from =
        std::min(line.text.find_first_not_of(' ', at + name.size()), line.text.size());
    const std::string_view behind = line.text.substr(from);
    const std::string text(trimmed(behind.substr(0, behind.find('"'))));
    if (is_of_screen(text)) {
      return;
    }
    setting = {text, line.number, from + 1};
    // As `CP-D`.
    if (is_equivalent_element(lower_case(text.substr(0, text.find_first_of(between_names))))) {
      throw error(setting, "is no impedance");
    }
  }

  static bool is_complex(const MeasuredTable& table) {
    if (table.names().size() < 3) {
      return false;
    }
    const std::vector<double> parts = table.numbers(2);
    return std::any_of(parts.begin(), parts.end(), [](double each) { return each != 0.0; });
  }

  /// Of `COMPLEX Z-Y` the first letter counts.
  SweepColumns complex_trace(Sweep& sweep) const {
    const Setting& named = parameter_.text.empty() ? traces_.front().format : parameter_;
    std::string text = lower_case(named.text);
    text = std::string(trimmed(text.rfind("complex", 0) == 0 ? text.substr(7) : text));
    const Subject subject = read_name(text.substr(0, text.find_first_of(between_names))).subject;
    if (subject == Subject::unknown && !named.text.empty()) {
      throw error(named, "is no complex trace that is known");
    }
    if (subject == Subject::unknown) {
      sweep.warnings.emplace_back(
          "The file does not name what its complex trace is; it is taken for an impedance in ohm.");
    }
    if (tables_.size() > 1) {
      sweep.warnings.emplace_back("Trace A is complex and is read; trace B is not read.");
    }
    return {{name_of(Role::real, subject), 1}, SweepColumn{name_of(Role::imaginary, subject), 2}};
  }

  SweepColumns pair(Sweep& sweep) const {
    const Setting& a = traces_[0].format;
    const Setting& b = traces_[1].format;
    const bool by_parameter = !parameter_.text.empty();
    if (!by_parameter && a.text.empty() && b.text.empty()) {
      sweep.warnings.emplace_back(
          "The file does not name what its traces are; A is taken for |Z| in ohm, B for its phase "
          "in degrees.");
      return *pair_of("|Z| (ohm)", "phase");
    }
    const auto found = by_parameter ? pair_of(parameter_.text) : pair_of(a.text, b.text);
    if (!found && by_parameter) {
      throw error(parameter_, "is no pair of traces that is known");
    }
    if (!found) {
      throw error({fmt::format("{}\" and \"{}", a.text, b.text), (b.text.empty() ? a : b).line,
                   (b.text.empty() ? a : b).column},
                  "are no pair of traces that is known");
    }
    return *found;
  }

  SweepColumns alone(Sweep& sweep) const {
    const Setting& named =
        traces_.front().format.text.empty() ? parameter_ : traces_.front().format;
    SweepColumns columns{{name_of(Role::magnitude, Subject::impedance), 1}, std::nullopt};
    if (!named.text.empty()) {
      const auto pair = pair_of(named.text);
      columns.first.name = pair ? pair->first.name : read_name(named.text);
      if (columns.first.name.role != Role::magnitude) {
        throw error(named, "alone, without trace B");
      }
    }
    sweep.warnings.emplace_back(
        "The file has no readings of trace B: the magnitudes of A are fitted alone.");
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
  std::deque<MeasuredTable> tables_;
};

}  // namespace

bool is_trace_export(const scene_file::Source& source) {
  return source.text.find("TRACE: A\"") != std::string::npos;
}

Sweep read_traces(const scene_file::Source& source) {
  return TraceReader(source).read();
}

}  // namespace sonoglide::identify::impedance
