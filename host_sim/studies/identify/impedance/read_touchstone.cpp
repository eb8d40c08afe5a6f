#include "host_sim/studies/identify/impedance/read_touchstone.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "host_sim/studies/identify/impedance/readings.hpp"
#include "host_sim/studies/identify/plain_text.hpp"
#include "host_sim/studies/identify/unit.hpp"

namespace sonoglide::identify::impedance {
namespace {

using Complex = std::complex<double>;
using scene_file::SceneError;

struct Options {
  double frequency_scale = 1e9;
  char parameter = 's';
  std::string format = "ma";
  double reference_ohm = 50.0;
};

/// The words of a line without its comment; commas between them are blanks.
std::vector<std::string> words_of(std::string_view line) {
  const std::string plain = plain_text(line.substr(0, line.find('!')));
  std::vector<std::string> words;
  for (const Cell& each : cells_of(plain, ' ')) {
    std::string word(each.text);
    while (!word.empty() && (word.back() == ',' || word.back() == ';')) {
      word.pop_back();
    }
    if (!word.empty()) {
      words.push_back(std::move(word));
    }
  }
  return words;
}

/// A resistance as `R 50`, `R50`, `R 50 Ohm`, beginning at the word `at`, which becomes the last one
/// that it takes.
bool take_resistance(const std::vector<std::string>& words, std::size_t& at, Options& options) {
  std::string number = words[at].substr(1);
  if (number.empty() && at + 1 < words.size()) {
    number = words[++at];
  }
  const std::size_t letters = std::min(number.find_first_of("kMmoO"), number.size());
  std::string unit = number.substr(letters);
  if (unit.empty() && at + 1 < words.size() && unit_of_word(words[at + 1]) &&
      unit_of_word(words[at + 1])->dimension == Dimension::impedance) {
    unit = words[++at];
  }
  const auto known = unit.empty() ? Unit{Dimension::impedance, 1.0} : unit_of_word(unit);
  if (!known || known->dimension != Dimension::impedance ||
      !parse_number(number.substr(0, letters), true, options.reference_ohm)) {
    return false;
  }
  options.reference_ohm *= known->scale;
  return true;
}

/// The options of a line `# ...`; nothing where it is none.
std::optional<Options> options_of(std::string_view line) {
  const std::size_t mark = line.find_first_not_of(" \t");
  if (mark == std::string_view::npos || line[mark] != '#') {
    return std::nullopt;
  }
  Options options;
  const std::vector<std::string> words = words_of(line.substr(mark + 1));
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string word = lower_case(words[i]);
    const auto unit = unit_of_word(word);
    if (unit && unit->dimension == Dimension::frequency) {
      options.frequency_scale = unit->scale;
    } else if (word.size() == 1 && std::string_view("syzgh").find(word) != std::string_view::npos) {
      options.parameter = word.front();
    } else if (word == "ri" || word == "ma" || word == "db") {
      options.format = word;
    } else if (word.front() != 'r' || !take_resistance(words, i, options)) {
      return std::nullopt;
    }
  }
  return options;
}

class TouchstoneReader {
 public:
  explicit TouchstoneReader(const scene_file::Source& source) : source_(source) {
    for (const Line& line : lines_of(source)) {
      if (!ended_) {
        take(line);
      }
    }
    if (count_ && *count_ != rows_.size()) {
      throw error(
          {{}, line_of_count_},
          fmt::format("[Number of Frequencies] is {}, and readings are {}; allowed: as many",
                      *count_, rows_.size()));
    }
  }

  Sweep read() const {
    const MeasuredTable table(
        source_, {{"frequency", "first number", "second number"}, {1, 1, 1}, 1, separator()},
        rows_);
    Sweep sweep;
    sweep.has_phase = true;
    ColumnName frequency;
    frequency.scale = options_.frequency_scale;
    sweep.frequency_Hz = frequencies_Hz(table, {frequency, 0});
    const std::vector<double> first = table.numbers(1);
    const std::vector<double> second = table.numbers(2);
    for (std::size_t row = 0; row < table.rows(); ++row) {
      const Complex admittance_S = admittance_of(value_of(first[row], second[row]));
      if (!std::isfinite(std::abs(admittance_S)) || std::abs(admittance_S) == 0.0) {
        throw table.error(row, 1,
                          "has an admittance of 0 or without end; allowed: one of a capacitance");
      }
      sweep.admittance_S.push_back(admittance_S);
    }
    if (!has_options_) {
      sweep.warnings.emplace_back(
          "The file has no option line; it is taken for frequencies in GHz and S11 as magnitude "
          "and degrees over 50 ohm, as the standard has it.");
    }
    sweep.format = fmt::format("a Touchstone file of {} ({}) over {:g} ohm",
                               static_cast<char>(std::toupper(options_.parameter)), options_.format,
                               options_.reference_ohm);
    return sweep;
  }

 private:
  void take(const Line& line) {
    const std::string_view text = trimmed(line.text.substr(0, line.text.find('!')));
    if (text.empty()) {
      return;
    }
    if (text.front() == '[') {
      take_keyword(line, text);
    } else if (in_information_) {
      return;
    } else if (text.front() == '#') {
      take_options(line);
    } else if (expects_reference_) {
      take_reference(line, text);
    } else {
      rows_.push_back({line.text.substr(0, line.text.find('!')), line.number});
    }
  }

  void take_options(const Line& line) {
    const auto options = options_of(line.text);
    if (has_options_) {
      return;  // Further option lines do not count.
    }
    if (!options) {
      throw error(line,
                  "is no option line; allowed: # [Hz|kHz|MHz|GHz] [S|Y|Z] [RI|MA|DB] [R ohm]");
    }
    if (options->parameter == 'g' || options->parameter == 'h' || !(options->reference_ohm > 0.0)) {
      throw error(
          line, "names what one port does not have; allowed: S, Y or Z over a resistance above 0");
    }
    options_ = *options;
    has_options_ = true;
  }

  void take_keyword(const Line& line, std::string_view text) {
    const std::size_t close = std::min(text.find(']'), text.size() - 1);
    const std::string keyword = lower_case(text.substr(1, close - 1));
    const std::string_view value = trimmed(text.substr(close + 1));
    double number = 0.0;
    const bool has_number = parse_number(value, false, number);
    if (keyword == "version") {
      if (!has_number || number < 2.0 || number >= 3.0) {
        throw error(line, "is no version that is known; allowed: 2.0, or none for version 1");
      }
      is_version_2_ = true;
    } else if (keyword == "number of ports") {
      if (number != 1.0) {
        throw error(line, fmt::format("has {} ports; allowed: 1", value));
      }
    } else if (keyword == "number of frequencies") {
      if (!has_number || number < 1.0) {
        throw error(line, "is no number of frequencies; allowed: from 1");
      }
      count_ = static_cast<std::size_t>(number);
      line_of_count_ = line.number;
    } else if (keyword == "reference") {
      value.empty() ? void(expects_reference_ = true) : take_reference(line, value);
    } else if (keyword == "begin information" || keyword == "end information") {
      in_information_ = keyword == "begin information";
    } else if (keyword == "end" || keyword == "noise data") {
      ended_ = true;
    } else if (keyword != "network data" && keyword != "matrix format" &&
               keyword != "number of noise frequencies") {
      throw error(line,
                  fmt::format("[{}] is not known; allowed: Version, Number of Ports, Number of "
                              "Frequencies, Reference, Matrix Format, Network Data, End",
                              keyword));
    }
  }

  void take_reference(const Line& line, std::string_view text) {
    expects_reference_ = false;
    if (!parse_number(text, false, options_.reference_ohm) || options_.reference_ohm <= 0.0) {
      throw error(line, fmt::format("\"{}\" is no reference of one port; allowed: a resistance "
                                    "above 0",
                                    text.substr(0, 40)));
    }
  }

  /// The one that parts the first row into three.
  char separator() const {
    if (!rows_.empty()) {
      for (const char each : {' ', ';', ','}) {
        const std::vector<Cell> cells = cells_of(rows_.front().text, each);
        const bool ends_with_comma = std::any_of(cells.begin(), cells.end(), [](const Cell& cell) {
          return !cell.text.empty() && (cell.text.back() == ',' || cell.text.back() == ';');
        });
        if (cells.size() == 3 && !ends_with_comma) {
          return each;
        }
      }
    }
    return ' ';
  }

  Complex value_of(double first, double second) const {
    if (options_.format == "ri") {
      return {first, second};
    }
    const double magnitude = options_.format == "db" ? std::pow(10.0, first / 20.0) : first;
    return magnitude * std::polar(1.0, second * unit_of_word("deg")->scale);
  }

  Complex admittance_of(Complex value) const {
    const double reference_ohm = is_version_2_ ? 1.0 : options_.reference_ohm;
    if (options_.parameter == 'y') {
      return value / reference_ohm;
    }
    if (options_.parameter == 'z') {
      return 1.0 / (value * reference_ohm);
    }
    return (1.0 - value) / ((1.0 + value) * options_.reference_ohm);
  }

  SceneError error(const Line& line, const std::string& message) const {
    const std::size_t first = line.text.find_first_not_of(" \t");
    return {{source_.file, line.number, first == std::string_view::npos ? 1 : first + 1},
            "touchstone",
            message};
  }

  const scene_file::Source& source_;
  Options options_;
  std::vector<Line> rows_;
  std::optional<std::size_t> count_;
  std::size_t line_of_count_ = 1;
  bool has_options_ = false;
  bool is_version_2_ = false;
  bool expects_reference_ = false;
  bool in_information_ = false;
  bool ended_ = false;
};

}  // namespace

bool is_touchstone(const scene_file::Source& source) {
  constexpr std::string_view ending = ".s1p";
  const std::string file = lower_case(source.file);
  if (file.size() > ending.size() && file.substr(file.size() - ending.size()) == ending) {
    return true;
  }
  const std::string_view text = source.text;
  for (std::size_t at = text.find_first_of("#["); at != std::string_view::npos;
       at = text.find_first_of("#[", at + 1)) {
    const bool begins_line = at == 0 || text[at - 1] == '\n' || text[at - 1] == '\r';
    if (!begins_line) {
      continue;
    }
    const std::string_view line = text.substr(at, text.find_first_of("\r\n", at) - at);
    // A bare # begins an empty comment of a table.
    const bool has_words = line.find_first_not_of("# \t") != std::string_view::npos;
    if (lower_case(line.substr(0, 9)) == "[version]" || (has_words && options_of(line))) {
      return true;
    }
  }
  return false;
}

Sweep read_touchstone(const scene_file::Source& source) {
  return TouchstoneReader(source).read();
}

}  // namespace sonoglide::identify::impedance
