#include "host_sim/studies/identify/impedance/read_traces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "host_sim/studies/identify/impedance/circuit.hpp"
#include "host_sim/studies/identify/impedance/sweep_columns.hpp"
#include "host_sim/studies/identify/measured_table.hpp"

namespace sonoglide::identify::impedance {
namespace {

using Complex = std::complex<double>;
using scene_file::SceneError;

constexpr std::string_view allowed_traces = "allowed: |Z|-theta, R-X, |Y|-theta, G-B";

struct Trace {
  std::optional<NamedColumn> named;
  std::string format;  ///< the name as it stands in the file
  std::size_t line_of_format = 0;
  std::vector<double> frequency_Hz;
  std::vector<Complex> values;
  std::vector<std::size_t> lines;
};

struct Traces {
  std::vector<NamedColumn> named;  ///< in the lines above the traces
  std::vector<Trace> traces;
};

/// Refuses a line as `"MEASUREMENT PARAMETER: CP-D"`: traces of what is neither an impedance nor an
/// admittance.
void refuse_foreign(const scene_file::Source& source, std::string_view line, std::size_t number) {
  const bool names = line.find("PARAMETER:") != std::string_view::npos ||
                     line.find("FORMAT:") != std::string_view::npos;
  const std::size_t colon = line.find(':');
  const std::size_t first =
      names ? line.find_first_not_of(" \"", colon + 1) : std::string_view::npos;
  if (first == std::string_view::npos) {
    return;
  }
  const std::string_view rest = line.substr(first, line.find('"', first) - first);
  const std::string word(rest.substr(0, rest.find_first_of("-/, ")));
  if (is_equivalent_element(word)) {
    throw SceneError({source.file, number, first + 1}, "trace",
                     fmt::format("\"{}\" is no impedance; {}", rest, allowed_traces));
  }
}

/// What a line as `"FORMAT: |Z|"` names, if it names a part of an impedance.
void take_names(std::string_view line, std::vector<NamedColumn>& named) {
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos) {
    return;
  }
  std::string text(line.substr(colon + 1));
  text.erase(std::remove(text.begin(), text.end(), '"'), text.end());
  // |Z|-theta, R-X: two names.
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find_first_of("-/,", begin), text.size());
    std::string unknown_unit;
    const NamedColumn column = read_name(text.substr(begin, end - begin), unknown_unit);
    if (column.role != Role::none && column.role != Role::frequency) {
      named.push_back(column);
    }
    begin = end + 1;
  }
}

/// What a line as `"FORMAT: |Z|"` below `"TRACE: A"` says of that trace.
void take_format(std::string_view line, std::size_t number, Trace& trace) {
  std::vector<NamedColumn> named;
  take_names(line, named);
  if (named.size() == 1 && !trace.named) {
    trace.named = named.front();
    const std::size_t from = line.find_first_not_of(": ", line.find(':'));
    trace.format = line.substr(from, line.find('"', from) - from);
    trace.line_of_format = number;
  }
}

void take_reading(const scene_file::Source& source, std::string_view line, std::size_t number,
                  Trace& trace) {
  const std::vector<Cell> cells =
      cells_of(line, line.find('\t') == std::string_view::npos ? ',' : '\t');
  double numbers[3] = {};
  for (std::size_t i = 0; i < std::min<std::size_t>(cells.size(), 3); ++i) {
    if (!parse_number(cells[i].text, false, numbers[i])) {
      throw SceneError({source.file, number, cells[i].column}, "trace",
                       fmt::format("\"{}\" is no number; allowed: a finite number",
                                   cells[i].text.substr(0, 40)));
    }
  }
  if (cells.size() < 2 || numbers[0] <= 0.0) {
    throw SceneError({source.file, number, 1}, "trace",
                     "is no reading; allowed: a frequency above 0, a real and an imaginary part");
  }
  trace.frequency_Hz.push_back(numbers[0]);
  trace.values.emplace_back(numbers[1], numbers[2]);
  trace.lines.push_back(number);
}

Traces split(const scene_file::Source& source) {
  Traces found;
  bool in_rows = false;
  const std::vector<std::string_view> lines = lines_of(source.text);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string_view line = lines[i];
    const bool blank = line.find_first_not_of(" \t") == std::string_view::npos;
    if (!in_rows) {
      refuse_foreign(source, line, i + 1);
    }
    if (line.find("TRACE:") != std::string_view::npos) {
      found.traces.emplace_back();
      in_rows = false;
    } else if (blank) {
      in_rows = in_rows && found.traces.back().values.empty();
    } else if (in_rows) {
      take_reading(source, line, i + 1, found.traces.back());
    } else if (!found.traces.empty() && line.find("Frequency") != std::string_view::npos) {
      in_rows = true;
    } else if (found.traces.empty()) {
      take_names(line, found.named);
    } else {
      take_format(line, i + 1, found.traces.back());
    }
  }
  return found;
}

bool has_imaginary_parts(const Trace& trace) {
  return std::any_of(trace.values.begin(), trace.values.end(),
                     [](Complex value) { return value.imag() != 0.0; });
}

bool is_pair(const NamedColumn& one, const NamedColumn& other) {
  return (one.role == Role::magnitude && other.role == Role::phase) ||
         (one.role == Role::real && other.role == Role::imaginary);
}

NamedColumn column(Role role) {
  NamedColumn named;
  named.role = role;
  return named;
}

/// What trace A is of a pair.
NamedColumn first_of_pair(const scene_file::Source& source, const Traces& found,
                          std::vector<std::string>& warnings) {
  const Trace& a = found.traces[0];
  const Trace& b = found.traces[1];
  if (a.named && b.named && is_pair(*a.named, *b.named)) {
    return *a.named;
  }
  for (std::size_t i = 0; i + 1 < found.named.size(); ++i) {
    if (is_pair(found.named[i], found.named[i + 1])) {
      return found.named[i];
    }
  }
  if (a.named || b.named) {
    throw SceneError({source.file, std::max(a.line_of_format, b.line_of_format), 1}, "trace",
                     fmt::format("\"{}\" and \"{}\" are no pair of traces that is known; {}",
                                 a.format, b.format, allowed_traces));
  }
  warnings.emplace_back(
      "The file does not name what its traces are; A is taken for |Z| in ohm, B for its phase in "
      "degrees.");
  return column(Role::magnitude);
}

/// What trace A is where there is no other: complex, or magnitudes.
NamedColumn single(const scene_file::Source& source, const Trace& a,
                   std::vector<std::string>& warnings) {
  const NamedColumn named = a.named.value_or(column(Role::magnitude));
  if (has_imaginary_parts(a)) {
    return named;
  }
  if (named.role != Role::magnitude) {
    throw SceneError({source.file, a.line_of_format, 1}, "trace",
                     fmt::format("\"{}\" alone, without trace B; {}", a.format, allowed_traces));
  }
  warnings.emplace_back(
      "The file has no readings of trace B: the magnitudes of A are fitted alone.");
  return named;
}

}  // namespace

bool is_trace_export(const scene_file::Source& source) {
  return source.text.find("\"TRACE: A\"") != std::string::npos;
}

Sweep read_traces(const scene_file::Source& source) {
  const Traces found = split(source);
  Sweep sweep;
  const auto fail = [&](std::size_t line, const std::string& message) {
    return SceneError({source.file, line, 1}, "trace", message);
  };
  if (found.traces.empty() || found.traces.front().values.empty()) {
    throw fail(1, "has no readings below \"Frequency\"; allowed: at least one");
  }
  const Trace& a = found.traces.front();
  const bool two = found.traces.size() > 1 && !found.traces[1].values.empty();
  if (two && a.frequency_Hz != found.traces[1].frequency_Hz) {
    throw fail(found.traces[1].lines.back(),
               "trace B has other frequencies than trace A; allowed: the same");
  }
  sweep.frequency_Hz = a.frequency_Hz;
  sweep.has_phase = two || has_imaginary_parts(a);
  const NamedColumn first =
      two ? first_of_pair(source, found, sweep.warnings) : single(source, a, sweep.warnings);
  const double radians = two_pi / 360.0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    Complex value = a.values[i];
    if (two) {
      const double other = found.traces[1].values[i].real();
      value = first.role == Role::real ? Complex(value.real(), other)
                                       : std::polar(std::abs(value.real()), other * radians);
    }
    const Complex admittance_S = first.is_admittance ? value : 1.0 / value;
    if (!std::isfinite(std::abs(admittance_S)) || std::abs(admittance_S) == 0.0) {
      throw fail(a.lines[i],
                 "has an admittance of 0 or without end; allowed: one of a capacitance");
    }
    sweep.admittance_S.push_back(admittance_S);
  }
  sweep.format = fmt::format("an analyser's export of {}", two ? "two traces" : "one trace");
  return sweep;
}

}  // namespace sonoglide::identify::impedance
