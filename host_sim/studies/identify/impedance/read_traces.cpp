#include "host_sim/studies/identify/impedance/read_traces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <optional>

#include "host_sim/studies/identify/impedance/readings.hpp"
#include "host_sim/studies/identify/plain_text.hpp"

namespace sonoglide::identify::impedance {
namespace {

using scene_file::SceneError;

constexpr std::string_view allowed_traces =
    "allowed: |Z|-theta, R-X, |Y|-theta, G-B, complex Z, complex Y";

/// What stands behind a colon in a line as `"FORMAT: |Z|"`.
struct Setting {
  std::string text;
  std::size_t line = 0;
  std::size_t column = 1;
};

struct Trace {
  std::optional<Setting> format;
  Heading heading;
  std::vector<Line> rows;
};

struct Export {
  std::optional<Setting> parameter;
  std::vector<Trace> traces;
};

SceneError error(const scene_file::Source& source, const Setting& at, const std::string& message) {
  return {{source.file, at.line, at.column}, "trace", fmt::format("\"{}\" {}", at.text, message)};
}

/// The setting of a line that names it.
std::optional<Setting> setting_of(const Line& line, std::string_view name) {
  const std::size_t at = line.text.find(name);
  if (at == std::string_view::npos) {
    return std::nullopt;
  }
  const std::size_t from =
      std::min(line.text.find_first_not_of(' ', at + name.size()), line.text.size());
  std::string_view text = line.text.substr(from);
  text = trimmed(text.substr(0, text.find('"')));
  return Setting{std::string(text), line.number, from + 1};
}

/// Refuses a setting as `CP-D`: traces of what is neither an impedance nor an admittance.
void refuse_equivalent(const scene_file::Source& source, const Setting& setting) {
  const std::string word = lower_case(setting.text.substr(0, setting.text.find_first_of("-/, ")));
  if (is_equivalent_element(word)) {
    throw error(source, setting, fmt::format("is no impedance; {}", allowed_traces));
  }
}

/// How the screen shows a trace says nothing of it.
bool is_of_screen(const std::string& format) {
  const std::string small = lower_case(format);
  return small.rfind("log", 0) == 0 || small.rfind("lin", 0) == 0 || small.empty();
}

Heading heading_of(const Line& line) {
  Heading heading;
  heading.line = line.number;
  heading.separator = line.text.find('\t') != std::string_view::npos  ? '\t'
                      : line.text.find(',') != std::string_view::npos ? ','
                                                                      : ' ';
  for (const Cell& each : cells_of(line.text, heading.separator)) {
    heading.names.emplace_back(each.text);
    heading.places.push_back(each.column);
  }
  return heading;
}

Export split(const scene_file::Source& source) {
  Export found;
  bool in_rows = false;
  for (const Line& line : lines_of(source)) {
    const bool is_row = in_rows && line.text.find('"') == std::string_view::npos;
    if (line.text.find("TRACE:") != std::string_view::npos) {
      found.traces.emplace_back();
      in_rows = false;
    } else if (found.traces.empty()) {
      if (auto parameter = setting_of(line, "PARAMETER:")) {
        refuse_equivalent(source, *parameter);
        found.parameter = std::move(parameter);
      }
    } else if (is_row) {
      found.traces.back().rows.push_back(line);
    } else if (line.text.find("Frequency") != std::string_view::npos) {
      found.traces.back().heading = heading_of(line);
      in_rows = true;
    } else if (auto format = setting_of(line, "FORMAT:"); format && !is_of_screen(format->text)) {
      refuse_equivalent(source, *format);
      found.traces.back().format = std::move(format);
    }
  }
  return found;
}

bool is_pair(const ColumnName& one, const ColumnName& other) {
  return (one.role == Role::magnitude && other.role == Role::phase) ||
         (one.role == Role::real && other.role == Role::imaginary);
}

/// The two names of which a text is made, as `R-X` or `ADMITTANCE MAG PHASE (DEG)`.
std::optional<SweepColumns> pair_of(const std::string& text) {
  for (std::size_t i = 1; i + 1 < text.size(); ++i) {
    if (std::string_view("-/, ").find(text[i]) == std::string_view::npos) {
      continue;
    }
    const ColumnName one = read_name(text.substr(0, i));
    ColumnName other = read_name(text.substr(i + 1));
    if (is_pair(one, other)) {
      return SweepColumns{{one, 1}, SweepColumn{other, 1}};
    }
  }
  return std::nullopt;
}

/// `COMPLEX Z-Y`: the first letter counts.
Subject subject_of(const std::optional<Setting>& setting) {
  std::string text = lower_case(setting ? setting->text : std::string());
  text = text.rfind("complex", 0) == 0 ? text.substr(7) : text;
  text = std::string(trimmed(text));
  const ColumnName name = read_name(text.substr(0, text.find_first_of("-/, ")));
  return name.subject;
}

ColumnName name_of(Role role, Subject subject, bool has_unit) {
  ColumnName name;
  name.role = role;
  name.subject = subject;
  name.has_unit = has_unit;
  return name;
}

class TraceReader {
 public:
  explicit TraceReader(const scene_file::Source& source) : source_(source), found_(split(source)) {
    for (const Trace& each : found_.traces) {
      if (!each.rows.empty()) {
        tables_.emplace_back(source, each.heading, each.rows);
      }
    }
    if (tables_.empty()) {
      throw SceneError({source.file, 1, 1}, "trace",
                       "has no readings below \"Frequency\"; allowed: at least one");
    }
  }

  Sweep read() {
    Sweep sweep;
    const MeasuredTable& a = tables_.front();
    sweep.frequency_Hz = frequencies_Hz(a, {name_of(Role::frequency, Subject::unknown, true), 0});
    const bool two = tables_.size() > 1;
    const bool complex = is_complex(a);
    const MeasuredTable& b = two && !complex ? tables_[1] : a;
    if (b.numbers(0) != a.numbers(0)) {
      throw SceneError({source_.file, found_.traces[1].rows.back().number, 1}, "trace",
                       "trace B has other frequencies than trace A; allowed: the same");
    }
    const SweepColumns columns = complex ? complex_trace(sweep) : two ? pair(sweep) : alone(sweep);
    sweep.has_phase = columns.second.has_value();
    sweep.admittance_S = admittances_S({&a, &b}, columns, sweep.warnings);
    sweep.format = fmt::format("an analyser's export of {}", columns.description());
    return sweep;
  }

 private:
  static bool is_complex(const MeasuredTable& table) {
    if (table.names().size() < 3) {
      return false;
    }
    const std::vector<double> parts = table.numbers(2);
    return std::any_of(parts.begin(), parts.end(), [](double each) { return each != 0.0; });
  }

  SweepColumns complex_trace(Sweep& sweep) const {
    const auto& named = found_.parameter ? found_.parameter : found_.traces.front().format;
    const Subject subject = subject_of(named);
    if (named && subject == Subject::unknown) {
      throw error(source_, *named,
                  fmt::format("is no complex trace that is known; {}", allowed_traces));
    }
    if (subject == Subject::unknown) {
      sweep.warnings.emplace_back(
          "The file does not name what its complex trace is; it is taken for an impedance in ohm.");
    }
    if (tables_.size() > 1) {
      sweep.warnings.emplace_back("Trace A is complex and is read; trace B is not read.");
    }
    return {{name_of(Role::real, subject, true), 1},
            SweepColumn{name_of(Role::imaginary, subject, true), 2}};
  }

  SweepColumns pair(Sweep& sweep) const {
    const auto& a = found_.traces[0].format;
    const auto& b = found_.traces[1].format;
    if (found_.parameter) {
      return pair_of_parameter();
    }
    if (!a && !b) {
      sweep.warnings.emplace_back(
          "The file does not name what its traces are; A is taken for |Z| in ohm, B for its phase "
          "in degrees.");
      return {{name_of(Role::magnitude, Subject::impedance, true), 1}, SweepColumn{degrees(), 1}};
    }
    const ColumnName one = read_name(a ? a->text : std::string());
    const ColumnName other = read_name(b ? b->text : std::string());
    if (!is_pair(one, other)) {
      throw SceneError({source_.file, (b ? b : a)->line, (b ? b : a)->column}, "trace",
                       fmt::format("\"{}\" and \"{}\" are no pair of traces that is known; {}",
                                   a ? a->text : "", b ? b->text : "", allowed_traces));
    }
    return in_degrees({{one, 1}, SweepColumn{other, 1}});
  }

  SweepColumns pair_of_parameter() const {
    const auto found = pair_of(found_.parameter->text);
    if (!found) {
      throw error(source_, *found_.parameter,
                  fmt::format("is no pair of traces that is known; {}", allowed_traces));
    }
    return in_degrees(*found);
  }

  /// A phase whose unit is not named is in degrees, as the instrument has them.
  static SweepColumns in_degrees(SweepColumns columns) {
    if (!columns.rectangular() && !columns.second->name.has_unit) {
      columns.second->name.scale *= degrees().scale;
      columns.second->name.has_unit = true;
    }
    return columns;
  }

  SweepColumns alone(Sweep& sweep) const {
    const auto& named =
        found_.traces.front().format ? found_.traces.front().format : found_.parameter;
    SweepColumns columns{{name_of(Role::magnitude, Subject::impedance, true), 1}, std::nullopt};
    if (named) {
      const auto pair = pair_of(named->text);
      columns.first.name = pair ? pair->first.name : read_name(named->text);
      if (columns.first.name.role != Role::magnitude) {
        throw error(source_, *named, fmt::format("alone, without trace B; {}", allowed_traces));
      }
    }
    sweep.warnings.emplace_back(
        "The file has no readings of trace B: the magnitudes of A are fitted alone.");
    return columns;
  }

  static ColumnName degrees() { return read_name("phase (deg)"); }

  const scene_file::Source& source_;
  Export found_;
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
