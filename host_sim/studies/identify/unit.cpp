#include "host_sim/studies/identify/unit.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <regex>

#include "host_sim/studies/identify/cell.hpp"
#include "host_sim/studies/identify/plain_text.hpp"

namespace sonoglide::identify {
namespace {

constexpr double radians_a_degree = 3.14159265358979323846 / 180.0;

struct Names {
  Dimension dimension;
  double scale;
  std::string_view names;  ///< in small letters, but for units of one letter
};

constexpr Names units[] = {
    {Dimension::frequency, 1.0, "hz hertz"},
    {Dimension::impedance, 1.0, "ohm ohms"},
    {Dimension::admittance, 1.0, "S s siemens mho mhos"},
    {Dimension::angle, radians_a_degree, "deg degs degree degrees"},
    {Dimension::angle, 1.0, "rad radian radians"},
    {Dimension::level, 1.0, "db dbohm decibel decibels"},
    {Dimension::other, 1.0, "V A W F H C K N m g % va pa volt volts vpp vrms bar dbm min sec"}};

struct Prefix {
  double scale;
  std::string_view symbols;
  std::string_view names;  ///< `kil` and `micr` as in kilohm and microhm
};

constexpr Prefix prefixes[] = {{1e-12, "p", " pico "},      {1e-9, "n", " nano "},
                               {1e-6, "u", " micro micr "}, {1e-3, "m", " milli "},
                               {1e3, "kK", " kilo kil "},   {1e6, "M", " mega meg "},
                               {1e9, "G", " giga "},        {1e12, "T", " tera "}};

std::optional<double> scale_of_symbol(std::string_view symbol) {
  for (const Prefix& each : prefixes) {
    if (symbol.size() == 1 && each.symbols.find(symbol) != std::string_view::npos) {
      return each.scale;
    }
  }
  return std::nullopt;
}

std::optional<double> scale_of_name(std::string_view name) {
  for (const Prefix& each : prefixes) {
    if (is_among(lower_case(name), each.names)) {
      return each.scale;
    }
  }
  return std::nullopt;
}

/// The scale of `prefix` before `unit`, both as they stand in the word.
std::optional<double> scale_before(std::string_view prefix, std::string_view unit,
                                   Dimension dimension) {
  if (prefix.empty()) {
    return 1.0;
  }
  if (const auto scale = scale_of_name(prefix)) {
    return unit.size() > 1 ? scale : std::nullopt;
  }
  const bool small = lower_case(unit) == unit;
  const bool capital = !small && lower_case(unit)[0] != unit[0] && unit.size() > 1 &&
                       std::none_of(unit.begin(), unit.end(),
                                    [](unsigned char each) { return std::islower(each) != 0; });
  std::string symbol(prefix);
  if (dimension == Dimension::frequency) {
    // All in small letters, as in names of columns: nobody measures in millihertz.
    symbol = small && symbol != "k" ? std::string(1, static_cast<char>(std::toupper(symbol[0])))
                                    : symbol;
    const bool is_known =
        symbol == "k" || symbol == "K" || symbol == "M" || symbol == "G" || symbol == "T";
    return is_known && prefix.size() == 1 ? scale_of_symbol(symbol) : std::nullopt;
  }
  const bool is_angle = dimension == Dimension::angle;  // Grad is no gigaradian.
  if ((unit == "s" || is_angle) && (lower_case(symbol) != symbol || (is_angle && symbol == "k"))) {
    return std::nullopt;
  }
  if (unit == "S" && (symbol == "M" || symbol == "G" || symbol == "T" || symbol == "P")) {
    return std::nullopt;
  }
  if ((capital || unit == "S") && (symbol == "U" || symbol == "N" || symbol == "P")) {
    symbol = lower_case(symbol);
  }
  return scale_of_symbol(symbol);
}

/// 10^3, 10**3, 1e3, 1000; nothing of what is no whole power of ten.
std::optional<double> power_of_ten(const std::string& text) {
  const std::size_t mark = std::min(text.find_first_of("^*"), text.size());
  const std::size_t power = std::min(text.find_first_not_of("^*", mark), text.size());
  double factor = 0.0;
  double exponent = 1.0;
  if (!parse_number(text.substr(0, mark), false, factor) ||
      (power < text.size() &&
       (factor != 10.0 || !parse_number(text.substr(power), false, exponent)))) {
    return std::nullopt;
  }
  const double digits = std::log10(factor) * exponent;
  constexpr double most = 15.0;
  return std::abs(digits - std::round(digits)) < 1e-9 && std::abs(digits) <= most
             ? std::optional(std::pow(10.0, std::round(digits)))
             : std::nullopt;
}

}  // namespace

std::optional<double> scale_of_prefix(std::string_view word) {
  const auto scale = scale_of_symbol(word);
  return scale ? scale : scale_of_name(word);
}

std::optional<Unit> unit_of_word(std::string_view word) {
  const std::string small = lower_case(word);
  std::optional<Unit> found;
  std::size_t longest = 0;
  for (const Names& each : units) {
    for (const Cell& name : cells_of(each.names, ' ')) {
      const std::size_t size = name.text.size();
      const std::size_t prefix = word.size() - std::min(size, word.size());
      const std::string_view ending = (size == 1 ? word : std::string_view(small)).substr(prefix);
      if (size <= longest || ending != name.text) {
        continue;
      }
      if (const auto scale =
              scale_before(word.substr(0, prefix), word.substr(prefix), each.dimension)) {
        found = Unit{each.dimension, *scale * each.scale};
        longest = size;
      }
    }
  }
  return found;
}

std::optional<Unit> unit_of_text(std::string_view text) {
  // A power of ten or 1/, a word, which a blank or a dash may part from its prefix, and ^-1 or a power.
  static const std::string power =
      R"((?:[*xX] *)?([0-9.]+(?:[eE][+-]?[0-9]+)?(?:(?:\^|\*\*)[+-]?[0-9]+)?) *)";
  static const std::regex form("(?:" + power +
                               R"((?:[*xX] *)?)?(/ *)?([^- ^*0-9/]+)(?:[- ]([A-Za-z]+))?)" +
                               R"( *(?:(\^?-1)|)" + power + ")?");
  constexpr std::size_t longest = 60;
  std::match_results<std::string_view::const_iterator> part;
  text = trimmed(text);
  if (text.size() > longest || !std::regex_match(text.begin(), text.end(), part, form) ||
      (part[4].matched && !scale_of_prefix(part[3].str()))) {
    return std::nullopt;
  }
  auto unit = unit_of_word(part[3].str() + part[4].str());
  const bool inverse = part[2].matched;
  const bool reciprocal = part[5].matched;
  if (unit && (inverse || reciprocal)) {
    const bool is_alone = inverse ? part[1] == "1" && !reciprocal : !part[1].matched;
    return unit->dimension == Dimension::impedance && is_alone && !part[6].matched
               ? std::optional(Unit{Dimension::admittance, 1.0 / unit->scale})
               : std::nullopt;
  }
  for (const auto& each : {part[1], part[6]}) {
    const auto factor = each.matched ? power_of_ten(each.str()) : 1.0;
    if (!unit || !factor) {
      return std::nullopt;
    }
    unit->scale *= *factor;
  }
  return unit;
}

std::string_view known_units() {
  return "Hz, deg, rad, ohm, S with a prefix from p to T or a power of ten, dB";
}

}  // namespace sonoglide::identify
