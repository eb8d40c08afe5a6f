#include "host_sim/studies/identify/unit.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

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

std::size_t past_blanks(std::string_view text, std::size_t at) {
  while (at < text.size() && text[at] == ' ') {
    ++at;
  }
  return at;
}

std::size_t past_times(std::string_view text, std::size_t at) {
  const bool times = at < text.size() && (text[at] == '*' || text[at] == 'x' || text[at] == 'X');
  return times ? past_blanks(text, at + 1) : at;
}

/// 10 raised by the whole number behind `^` or `**`; the base alone where none stands there.
std::optional<double> raised(double base, std::string_view text, std::size_t& at) {
  const std::size_t mark = text.substr(at, 2) == "**" ? 2 : text.substr(at, 1) == "^" ? 1 : 0;
  if (mark == 0) {
    return base;
  }
  at += mark;
  at += text.substr(at, 1) == "+" ? 1 : 0;
  int power = 0;
  const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), power);
  constexpr int most = 15;
  if (base != 10.0 || error != std::errc() || std::abs(power) > most) {
    return std::nullopt;
  }
  at = static_cast<std::size_t>(end - text.data());
  return std::pow(10.0, power);
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

std::optional<double> power_of_ten(std::string_view text, std::size_t& size) {
  std::size_t at = past_times(text, 0);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), value);
  if (error != std::errc() || !(value > 0.0)) {
    return std::nullopt;
  }
  at = static_cast<std::size_t>(end - text.data());
  const auto factor = raised(value, text, at);
  if (!factor || std::abs(std::log10(*factor) - std::round(std::log10(*factor))) > 1e-9) {
    return std::nullopt;
  }
  size = past_times(text, past_blanks(text, at));
  return std::pow(10.0, std::round(std::log10(*factor)));
}

std::optional<Unit> unit_of_text(std::string_view text) {
  text = trimmed(text);
  double factor = 1.0;
  std::size_t size = 0;
  if (const auto before = power_of_ten(text, size)) {
    factor = *before;
    text.remove_prefix(size);
  }
  const bool inverse = size > 0 && factor == 1.0 && text.substr(0, 1) == "/";
  if (inverse) {
    text.remove_prefix(past_blanks(text, 1));
  }
  const std::size_t length = std::min(text.find_first_of(" -^*0123456789"), text.size());
  std::string word(text.substr(0, length));
  std::string_view rest = text.substr(length);
  // k Ohm, kilo-ohm
  if (scale_of_prefix(word) && rest.size() > 1 &&
      std::isalpha(static_cast<unsigned char>(rest[1]))) {
    const std::size_t next = std::min(rest.find_first_of(" -^*0123456789", 1), rest.size());
    word += rest.substr(1, next - 1);
    rest.remove_prefix(next);
  }
  auto unit = unit_of_word(word);
  if (!unit) {
    return std::nullopt;
  }
  const bool reciprocal = rest == "^-1" || rest == "-1";
  if (inverse || reciprocal) {
    if (unit->dimension != Dimension::impedance || inverse == reciprocal) {
      return std::nullopt;
    }
    return Unit{Dimension::admittance, 1.0 / unit->scale};
  }
  rest = trimmed(rest);
  if (!rest.empty()) {
    const auto behind = power_of_ten(rest, size);
    if (!behind || size != rest.size()) {
      return std::nullopt;
    }
    factor *= *behind;
  }
  unit->scale *= factor;
  return unit;
}

std::string_view known_units() {
  return "Hz, deg, rad, ohm, S with a prefix from p to T or a power of ten, dB";
}

}  // namespace sonoglide::identify
