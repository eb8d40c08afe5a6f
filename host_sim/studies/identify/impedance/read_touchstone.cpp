#include "host_sim/studies/identify/impedance/read_touchstone.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <regex>

#include "host_sim/studies/identify/impedance/sweep_columns.hpp"
#include "host_sim/studies/identify/plain_text.hpp"
#include "host_sim/studies/identify/unit.hpp"

namespace sonoglide::identify::impedance {
namespace {

struct Options {
  double frequency_scale = 1e9;
  std::string parameter = "S";
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
  Options options;
  std::string plain = plain_text(line.substr(1));
  // R50, R 50 Ohm, R 0,05 kOhm
  static const std::regex resistance(
      "(^| )r *([0-9](?:[0-9.,e+-]*[0-9.])?),? *([a-z]*ohms?)?(?=[ ,]|$)", std::regex::icase);
  if (std::smatch found; std::regex_search(plain, found, resistance)) {
    const auto unit = unit_of_word(found[3].matched ? found.str(3) : "ohm");
    const auto number = number_of(found.str(2));
    if (!unit || !number) {
      return std::nullopt;
    }
    options.reference_ohm = *number * unit->scale;
    plain = found.prefix().str() + found.suffix().str();
  }
  for (const Cell& each : cells_of(plain, ' ')) {
    const std::string word = lower_case(each.text.substr(0, each.text.find_last_not_of(",;") + 1));
    const auto unit = unit_of_word(word);
    if (unit && unit->dimension == Dimension::frequency) {
      options.frequency_scale = unit->scale;
    } else if (is_among(word, " s y z g h ")) {
      options.parameter = word == "s" ? "S" : word == "y" ? "Y" : word == "z" ? "Z" : "";
    } else if (is_among(word, " ri ma db ")) {
      options.format = word;
    } else if (!word.empty()) {
      return std::nullopt;
    }
  }
  return options;
}

class TouchstoneReader {
 public:
  explicit TouchstoneReader(const scene_file::Source& source) : source_(source) {
    for (const Line& line : lines_of(source)) {
      const Line text{line.text.substr(0, line.text.find('!')), line.number};
      if (!ended_ && !trimmed(text.text).empty()) {
        take(text, trimmed(text.text));
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
  void take(const Line& line, std::string_view text) {
    if (text.front() == '[') {
      take_keyword(line, text);
    } else if (in_information_) {
      return;
    } else if (text.front() == '#') {
      take_options(line);
    } else if (expects_reference_) {
      take_reference(line, text);
    } else {
      rows_.push_back(line);
    }
  }

  void take_options(const Line& line) {
    if (has_options_) {
      return;  // Further option lines do not count.
    }
    const auto options = options_of(line.text);
    if (!options) {
      throw error(line,
                  "is no option line; allowed: # [Hz|kHz|MHz|GHz] [S|Y|Z] [RI|MA|DB] [R ohm]");
    }
    if (options->parameter.empty() || !(options->reference_ohm > 0.0)) {
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
    const double number = number_of(value).value_or(0.0);
    const auto require = [&](bool right, std::string_view allowed) {
      if (!right) {
        throw error(line, fmt::format("[{}] is {}; allowed: {}", shortened(keyword),
                                      shortened(value), allowed));
      }
    };
    if (keyword == "version") {
      require(number >= 2.0 && number < 3.0, "2.0, or no such line for version 1");
      is_version_2_ = true;
    } else if (keyword == "number of ports") {
      require(number == 1.0, "1");
    } else if (keyword == "number of frequencies") {
      require(number >= 1.0, "from 1");
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
                              shortened(keyword)));
    }
  }

  void take_reference(const Line& line, std::string_view text) {
    expects_reference_ = false;
    options_.reference_ohm = number_of(text).value_or(0.0);
    if (!(options_.reference_ohm > 0.0)) {
      throw error(line, fmt::format("\"{}\" is no reference of one port; allowed: a resistance "
                                    "above 0",
                                    shortened(text)));
    }
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
    const double unit_ohm = is_version_2_ ? 1.0 : options_.reference_ohm;
    if (options_.parameter == "S") {
      first.subject = Subject::reflection;
    } else if (options_.parameter == "Y") {
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
  std::optional<std::size_t> count_;
  std::size_t line_of_count_ = 1;
  bool has_options_ = false;
  bool is_version_2_ = false;
  bool expects_reference_ = false;
  bool in_information_ = false;
  bool ended_ = false;
};

/// A bare # begins an empty comment of a table.
bool is_of_touchstone(const Line& line) {
  return lower_case(line.text.substr(0, 9)) == "[version]" ||
         (line.text.find_first_not_of("# \t") != std::string_view::npos && options_of(line.text));
}

}  // namespace

bool is_touchstone(const scene_file::Source& source) {
  const std::vector<Line> lines = lines_of(source);
  return lower_case(std::filesystem::path(source.file).extension().string()) == ".s1p" ||
         std::any_of(lines.begin(), lines.end(), is_of_touchstone);
}

Sweep read_touchstone(const scene_file::Source& source) {
  return TouchstoneReader(source).read();
}

}  // namespace sonoglide::identify::impedance
