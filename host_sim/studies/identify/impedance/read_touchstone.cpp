#include "host_sim/studies/identify/impedance/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <optional>

#include "host_sim/process/regular_expression.hpp"
#include "host_sim/studies/identify/impedance/sweep_columns.hpp"
#include "host_sim/studies/identify/text_file.hpp"
#include "host_sim/studies/identify/unit.hpp"

namespace sonoglide::identify::impedance {
namespace {

struct Options {
  double frequency_scale = 1e9;
  char parameter = 'S';
  std::string format = "ma";
  double reference_ohm = 50.0;
};

/// The options of a line `# ...`; nothing where it is none. Commas between them are blanks.
std::optional<Options> options_of(std::string_view line) {
  constexpr std::size_t longest = 200;
  line = trimmed(line.substr(0, line.find('!')));
  if (line.substr(0, 1) != "#" || line.size() > longest) {
    return std::nullopt;
  }
  // A word, or R50, R 50 Ohm, R 0,05 kOhm.
  static const process::RegularExpression option(
      "^[ ,;]*(?:r *([0-9](?:[0-9.,e+-]*[0-9.])?),? *([a-z]*ohms?)?|([a-z]+))(?=[ ,;]|$)[ ,;]*");
  Options options;
  std::string left = lower_case(trimmed(plain_text(line.substr(1))));
  for (process::Match found; !left.empty(); left.erase(0, found[0].size())) {
    found = option.search(left);
    if (found.empty()) {
      return std::nullopt;
    }
    const std::string word = found[3];
    const auto unit = unit_of_word(!found[2].empty() ? found[2] : word.empty() ? "ohm" : word);
    if (word.empty()) {
      options.reference_ohm = number_of(found[1]).value_or(0.0) * (unit ? unit->scale : 0.0);
    } else if (unit && unit->dimension == Dimension::frequency) {
      options.frequency_scale = unit->scale;
    } else if (is_among(word, " s y z g h ")) {
      options.parameter = static_cast<char>(std::toupper(word.front()));
    } else if (is_among(word, " ri ma db ")) {
      options.format = word;
    } else {
      return std::nullopt;
    }
  }
  return options;
}

/// What may stand behind a keyword of version 2.
struct Keyword {
  std::string_view name;
  double least = 0.0;
  double most = 0.0;
  std::string_view allowed = "";
};

constexpr Keyword keywords[] = {{"version", 2.0, 2.9, "2.0, or no such line for version 1"},
                                {"number of ports", 1.0, 1.0, "1"},
                                {"number of frequencies", 1.0, 1e9, "from 1"},
                                {"reference", 1e-300, 1e300, "a resistance above 0"},
                                {"matrix format"},
                                {"begin information"},
                                {"end information"},
                                {"network data"},
                                {"number of noise frequencies"},
                                {"noise data"},
                                {"end"}};

class TouchstoneReader {
 public:
  explicit TouchstoneReader(const scene_file::Source& source) : source_(source) {
    std::vector<Line> lines;
    for (const Line& each : lines_of(source)) {
      const std::string_view text = each.text.substr(0, each.text.find('!'));
      if (!trimmed(text).empty()) {
        lines.push_back({text, each.number});
      }
    }
    for (std::size_t i = 0; i < lines.size() && last_ != "end" && last_ != "noise data"; ++i) {
      const std::string_view text = trimmed(lines[i].text);
      if (text.front() == '[') {
        const bool is_alone = text.back() == ']' && i + 1 < lines.size();
        take_keyword(lines[i], text, is_alone ? lines[i + 1].text : "");
        i += is_alone && last_ == "reference" ? 1 : 0;
      } else if (last_ != "begin information") {
        text.front() == '#' ? take_options(lines[i]) : rows_.push_back(lines[i]);
      }
    }
    const auto count = values_.find("number of frequencies");
    if (count != values_.end() && count->second != static_cast<double>(rows_.size())) {
      throw error(
          line_of_count_,
          fmt::format("[Number of Frequencies] is {}, and readings are {}; allowed: as many",
                      count->second, rows_.size()));
    }
    if (values_.count("reference") > 0) {
      options_.reference_ohm = values_.at("reference");
    }
  }

  Sweep read() const {
    const MeasuredTable table(
        source_,
        {{{"frequency", "first number", "second number"}, {1, 1, 1}, 1, separator()}, rows_, {}});
    ColumnName frequency;
    frequency.scale = options_.frequency_scale;
    Sweep sweep = sweep_of(table, table, frequency, columns());
    if (!has_options_) {
      sweep.warnings.emplace_back(
          "The file has no option line; it is taken for frequencies in GHz and S11 as magnitude "
          "and degrees over 50 ohm, as the standard has it.");
    }
    sweep.format = fmt::format("a Touchstone file of {} ({}) over {:g} ohm", options_.parameter,
                               options_.format, options_.reference_ohm);
    return sweep;
  }

 private:
  void take_options(const Line& line) {
    if (has_options_) {
      return;  // Further option lines do not count.
    }
    const auto options = options_of(line.text);
    if (!options) {
      throw error(line,
                  "is no option line; allowed: # [Hz|kHz|MHz|GHz] [S|Y|Z] [RI|MA|DB] [R ohm]");
    }
    if (is_among(std::string(1, options->parameter), " G H ") || !(options->reference_ohm > 0.0)) {
      throw error(
          line, "names what one port does not have; allowed: S, Y or Z over a resistance above 0");
    }
    options_ = *options;
    has_options_ = true;
  }

  /// @param below  where a value may stand that is not behind the keyword
  void take_keyword(const Line& line, std::string_view text, std::string_view below) {
    const std::size_t close = std::min(text.find(']'), text.size() - 1);
    last_ = lower_case(text.substr(1, close - 1));
    const auto* const known = std::find_if(std::begin(keywords), std::end(keywords),
                                           [&](const Keyword& each) { return each.name == last_; });
    if (known == std::end(keywords)) {
      throw error(line,
                  fmt::format("[{}] is not known; allowed: Version, Number of Ports, Number of "
                              "Frequencies, Reference, Matrix Format, Network Data, End",
                              shortened(last_)));
    }
    const std::string_view behind = trimmed(text.substr(close + 1));
    const std::string_view value = behind.empty() ? trimmed(below) : behind;
    const double number = number_of(value).value_or(0.0);
    if (!known->allowed.empty() && (number < known->least || number > known->most)) {
      throw error(line,
                  fmt::format("[{}] is {}; allowed: {}", last_, shortened(value), known->allowed));
    }
    values_[last_] = number;
    line_of_count_ = last_ == "number of frequencies" ? line : line_of_count_;
  }

  /// The one that parts the first row into three.
  char separator() const {
    for (const char each : {';', ','}) {
      if (!rows_.empty() && cells_of(rows_.front().text, each).size() == 3) {
        return each;
      }
    }
    return ' ';
  }

  /// Version 1 normalises Y and Z to the reference.
  SweepColumns columns() const {
    const bool in_parts = options_.format == "ri";
    const char* const magnitude = options_.format == "db" ? "|Z| (dB)" : "|Z|";
    SweepColumns columns{read_name(in_parts ? "Re(Z)" : magnitude),
                         read_name(in_parts ? "Im(Z)" : "phase (deg)"), options_.reference_ohm};
    ColumnName& first = columns.first;
    ColumnName& second = *columns.second;
    first.index = 1;
    second.index = 2;
    const double unit_ohm = values_.count("version") > 0 ? 1.0 : options_.reference_ohm;
    if (options_.parameter == 'S') {
      first.subject = Subject::reflection;
    } else if (options_.parameter == 'Y') {
      first.subject = Subject::admittance;
      first.scale = 1.0 / unit_ohm;
    } else {
      first.scale = unit_ohm;
    }
    second.scale *= in_parts ? first.scale : 1.0;
    return columns;
  }

  scene_file::SceneError error(const Line& line, const std::string& message) const {
    const std::size_t first = std::min(line.text.find_first_not_of(" \t"), line.text.size());
    return {{source_.file, line.number, first + 1}, "touchstone", message};
  }

  const scene_file::Source& source_;
  Options options_;
  std::vector<Line> rows_;
  std::map<std::string, double> values_;  ///< behind the keywords
  std::string last_;                      ///< keyword
  Line line_of_count_{};
  bool has_options_ = false;
};

/// A bare # begins an empty comment of a table.
bool is_of_touchstone(const Line& line) {
  return lower_case(line.text.substr(0, 9)) == "[version]" ||
         (line.text.find_first_not_of("# \t") != std::string_view::npos && options_of(line.text));
}

}  // namespace

std::optional<Sweep> read_touchstone(const scene_file::Source& source) {
  const std::vector<Line> lines = lines_of(source);
  const bool is_named =
      lower_case(std::filesystem::path(source.file).extension().string()) == ".s1p";
  return is_named || std::any_of(lines.begin(), lines.end(), is_of_touchstone)
             ? std::optional(TouchstoneReader(source).read())
             : std::nullopt;
}

}  // namespace sonoglide::identify::impedance
