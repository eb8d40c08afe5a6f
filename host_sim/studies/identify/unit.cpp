#include "host_sim/studies/identify/unit.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "host_sim/studies/identify/plain_text.hpp"

namespace sonoglide::identify {
namespace {

constexpr double radians_a_degree = 3.14159265358979323846 / 180.0;

struct Name {
  std::string_view name;  ///< in small letters, but for units of one letter
  Dimension dimension;
  double scale;
};

/// The longest that ends a word is its unit.
constexpr Name units[] = {{"siemens", Dimension::admittance, 1.0},
                          {"decibels", Dimension::level, 1.0},
                          {"decibel", Dimension::level, 1.0},
                          {"degrees", Dimension::angle, radians_a_degree},
                          {"radians", Dimension::angle, 1.0},
                          {"degree", Dimension::angle, radians_a_degree},
                          {"radian", Dimension::angle, 1.0},
                          {"hertz", Dimension::frequency, 1.0},
                          {"ohms", Dimension::impedance, 1.0},
                          {"mhos", Dimension::admittance, 1.0},
                          {"degs", Dimension::angle, radians_a_degree},
                          {"volts", Dimension::other, 1.0},
                          {"volt", Dimension::other, 1.0},
                          {"vpp", Dimension::other, 1.0},
                          {"vrms", Dimension::other, 1.0},
                          {"bar", Dimension::other, 1.0},
                          {"dbm", Dimension::other, 1.0},
                          {"min", Dimension::other, 1.0},
                          {"sec", Dimension::other, 1.0},
                          {"ohm", Dimension::impedance, 1.0},
                          {"mho", Dimension::admittance, 1.0},
                          {"deg", Dimension::angle, radians_a_degree},
                          {"rad", Dimension::angle, 1.0},
                          {"hz", Dimension::frequency, 1.0},
                          {"db", Dimension::level, 1.0},
                          {"va", Dimension::other, 1.0},
                          {"pa", Dimension::other, 1.0},
                          {"S", Dimension::admittance, 1.0},
                          {"s", Dimension::admittance, 1.0},
                          {"V", Dimension::other, 1.0},
                          {"A", Dimension::other, 1.0},
                          {"W", Dimension::other, 1.0},
                          {"F", Dimension::other, 1.0},
                          {"H", Dimension::other, 1.0},
                          {"C", Dimension::other, 1.0},
                          {"K", Dimension::other, 1.0},
                          {"N", Dimension::other, 1.0},
                          {"m", Dimension::other, 1.0},
                          {"g", Dimension::other, 1.0},
                          {"%", Dimension::other, 1.0}};

struct Prefix {
  std::string_view name;
  double scale;
};

constexpr Prefix symbols[] = {{"p", 1e-12}, {"n", 1e-9}, {"u", 1e-6}, {"m", 1e-3}, {"k", 1e3},
                              {"K", 1e3},   {"M", 1e6},  {"G", 1e9},  {"T", 1e12}};
/// `kil` and `micr` as in kilohm and microhm.
constexpr Prefix words[] = {{"pico", 1e-12}, {"nano", 1e-9}, {"micro", 1e-6}, {"micr", 1e-6},
                            {"milli", 1e-3}, {"kilo", 1e3},  {"kil", 1e3},    {"mega", 1e6},
                            {"meg", 1e6},    {"giga", 1e9},  {"tera", 1e12}};

std::string lower(std::string_view text) {
  std::string small(text);
  std::transform(small.begin(), small.end(), small.begin(),
                 [](unsigned char each) { return static_cast<char>(std::tolower(each)); });
  return small;
}

template <std::size_t Count>
std::optional<double> scale_among(std::string_view name, const Prefix (&prefixes)[Count]) {
  const auto* const found = std::find_if(std::begin(prefixes), std::end(prefixes),
                                         [&](const Prefix& each) { return each.name == name; });
  return found == std::end(prefixes) ? std::nullopt : std::optional(found->scale);
}

/// The scale of `prefix` before `unit`, both as they stand in the word.
std::optional<double> scale_before(std::string_view prefix, std::string_view unit,
                                   Dimension dimension) {
  if (prefix.empty()) {
    return 1.0;
  }
  if (const auto scale = scale_among(lower(prefix), words)) {
    return unit.size() > 1 ? scale : std::nullopt;
  }
  const bool small = lower(unit) == unit;
  const bool capital = !small && lower(unit)[0] != unit[0] && unit.size() > 1 &&
                       std::none_of(unit.begin(), unit.end(),
                                    [](unsigned char each) { return std::islower(each) != 0; });
  std::string symbol(prefix);
  if (dimension == Dimension::frequency) {
    // All in small letters, as in names of columns: nobody measures in millihertz.
    symbol = small && symbol != "k" ? std::string(1, static_cast<char>(std::toupper(symbol[0])))
                                    : symbol;
    const bool is_known =
        symbol == "k" || symbol == "K" || symbol == "M" || symbol == "G" || symbol == "T";
    return is_known && prefix.size() == 1 ? scale_among(symbol, symbols) : std::nullopt;
  }
  const bool is_angle = dimension == Dimension::angle;  // Grad is no gigaradian.
  if ((unit == "s" || is_angle) && (lower(symbol) != symbol || (is_angle && symbol == "k"))) {
    return std::nullopt;
  }
  if (unit == "S" && (symbol == "M" || symbol == "G" || symbol == "T" || symbol == "P")) {
    return std::nullopt;
  }
  if ((capital || unit == "S") && (symbol == "U" || symbol == "N" || symbol == "P")) {
    symbol = lower(symbol);
  }
  return scale_among(symbol, symbols);
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
  const auto symbol = scale_among(word, symbols);
  return symbol ? symbol : scale_among(lower(word), words);
}

std::optional<Unit> unit_of_word(std::string_view word) {
  const std::string small = lower(word);
  for (const Name& each : units) {
    const std::string_view ending = each.name.size() == 1 ? word : std::string_view(small);
    if (ending.size() < each.name.size() ||
        ending.substr(ending.size() - each.name.size()) != each.name) {
      continue;
    }
    const std::size_t prefix = word.size() - each.name.size();
    if (const auto scale =
            scale_before(word.substr(0, prefix), word.substr(prefix), each.dimension)) {
      return Unit{each.dimension, *scale * each.scale};
    }
  }
  return std::nullopt;
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
