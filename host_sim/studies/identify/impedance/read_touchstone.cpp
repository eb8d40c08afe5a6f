#include "host_sim/studies/identify/impedance/read_touchstone.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <string_view>
#include <vector>

#include "host_sim/studies/identify/impedance/circuit.hpp"
#include "host_sim/studies/identify/measured_table.hpp"

namespace sonoglide::identify::impedance {
namespace {

using Complex = std::complex<double>;
using scene_file::SceneError;

struct TouchstoneOptions {
  double frequency_scale = 1e9;
  char parameter = 's';
  std::string format = "ma";
  double reference_ohm = 50.0;
};

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& each : lower) {
    each = static_cast<char>(std::tolower(static_cast<unsigned char>(each)));
  }
  return lower;
}

/// Takes one word of an option line; `next` is the one behind it. False: no word of one.
bool take_option(const std::string& word, std::string_view next, TouchstoneOptions& options) {
  if (word == "hz" || word == "khz" || word == "mhz" || word == "ghz") {
    options.frequency_scale = word == "hz" ? 1.0 : word == "khz" ? 1e3 : word == "mhz" ? 1e6 : 1e9;
    return true;
  }
  if (word.size() == 1 && std::string_view("syzgh").find(word) != std::string_view::npos) {
    options.parameter = word.front();
    return true;
  }
  if (word == "ri" || word == "ma" || word == "db") {
    options.format = word;
    return true;
  }
  return word == "r" && parse_number(next, false, options.reference_ohm);
}

/// The options of a line `# ...`; false where it is none.
bool parse_options(std::string_view line, TouchstoneOptions& options) {
  const std::size_t mark = line.find_first_not_of(" \t");
  if (mark == std::string_view::npos || line[mark] != '#') {
    return false;
  }
  const std::string_view body = line.substr(mark + 1, line.find('!') - mark - 1);
  const std::vector<Cell> words = cells_of(body, ' ');
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string_view next = i + 1 < words.size() ? words[i + 1].text : std::string_view();
    const std::string word = lower_case(words[i].text);
    if (!take_option(word, next, options)) {
      return false;
    }
    i += word == "r" ? 1 : 0;
  }
  return true;
}

bool has_ending(std::string_view file, std::string_view ending) {
  return file.size() > ending.size() &&
         lower_case(file.substr(file.size() - ending.size())) == ending;
}

Complex value_of(const TouchstoneOptions& options, double first, double second) {
  const double radians = second * two_pi / 360.0;
  if (options.format == "ri") {
    return {first, second};
  }
  return std::polar(options.format == "db" ? std::pow(10.0, first / 20.0) : first, radians);
}

Complex admittance_of(const TouchstoneOptions& options, Complex value) {
  if (options.parameter == 'y') {
    return value / options.reference_ohm;
  }
  if (options.parameter == 'z') {
    return 1.0 / (value * options.reference_ohm);
  }
  return (1.0 - value) / ((1.0 + value) * options.reference_ohm);
}

}  // namespace

bool is_touchstone(const scene_file::Source& source) {
  if (has_ending(source.file, ".s1p")) {
    return true;
  }
  const std::string_view text = source.text;
  for (std::size_t at = text.find('#'); at != std::string_view::npos; at = text.find('#', at + 1)) {
    const bool begins_line = at == 0 || text[at - 1] == '\n' || text[at - 1] == '\r';
    const std::string_view line = text.substr(at, text.find_first_of("\r\n", at) - at);
    // A bare # begins an empty comment of a table.
    TouchstoneOptions options;
    if (begins_line && line.find_first_not_of("# \t") != std::string_view::npos &&
        parse_options(line, options)) {
      return true;
    }
  }
  return false;
}

Sweep read_touchstone(const scene_file::Source& source) {
  TouchstoneOptions options;
  Sweep sweep;
  sweep.has_phase = true;
  bool has_options = false;
  const std::vector<std::string_view> lines = lines_of(source.text);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string_view line = lines[i].substr(0, lines[i].find('!'));
    const std::vector<Cell> cells = cells_of(line, ' ');
    const auto fail = [&](std::size_t column, const std::string& message) {
      return SceneError({source.file, i + 1, column}, "touchstone", message);
    };
    if (cells.empty()) {
      continue;
    }
    if (cells.front().text.front() == '[') {
      throw fail(1, "has keywords in brackets, as version 2; allowed: version 1 of one port");
    }
    if (cells.front().text.front() == '#') {
      // Further option lines do not count.
      if (!has_options && !parse_options(line, options)) {
        throw fail(1, "is no option line; allowed: # [Hz|kHz|MHz|GHz] [S|Y|Z] [RI|MA|DB] [R ohm]");
      }
      if (options.parameter == 'g' || options.parameter == 'h' || !(options.reference_ohm > 0.0)) {
        throw fail(1,
                   "names what one port does not have; allowed: S, Y or Z over a resistance "
                   "above 0");
      }
      has_options = true;
      continue;
    }
    if (cells.size() != 3) {
      throw fail(
          cells.back().column,
          fmt::format("{} numbers; allowed: 3, a frequency and two of one port", cells.size()));
    }
    double numbers[3] = {};
    for (std::size_t cell = 0; cell < 3; ++cell) {
      if (!parse_number(cells[cell].text, false, numbers[cell])) {
        throw fail(cells[cell].column, fmt::format("\"{}\" is no number; allowed: a finite number",
                                                   cells[cell].text.substr(0, 40)));
      }
    }
    if (numbers[0] <= 0.0) {
      throw fail(cells[0].column,
                 fmt::format("\"{}\" is no frequency; allowed: above 0", cells[0].text));
    }
    const Complex admittance_S = admittance_of(options, value_of(options, numbers[1], numbers[2]));
    if (!std::isfinite(std::abs(admittance_S)) || std::abs(admittance_S) == 0.0) {
      throw fail(cells[1].column,
                 "has an admittance of 0 or without end; allowed: one of a capacitance");
    }
    sweep.frequency_Hz.push_back(numbers[0] * options.frequency_scale);
    sweep.admittance_S.push_back(admittance_S);
  }
  if (!has_options) {
    sweep.warnings.emplace_back(
        "The file has no option line; it is taken for frequencies in GHz and S11 as magnitude and "
        "degrees over 50 ohm, as the standard has it.");
  }
  sweep.format = fmt::format("a Touchstone file of {} ({}) over {:g} ohm",
                             static_cast<char>(std::toupper(options.parameter)), options.format,
                             options.reference_ohm);
  return sweep;
}

}  // namespace sonoglide::identify::impedance
