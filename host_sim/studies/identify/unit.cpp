#include "host_sim/studies/identify/unit.hpp"
#include "firmware/numeric/turn.hpp"

#include <algorithm>
#include <cmath>

#include "host_sim/process/regular_expression.hpp"
#include "host_sim/studies/identify/text_file.hpp"

namespace sonoglide::identify {
namespace {

constexpr double radians_a_degree = numeric::half_turn / 180.0;

/// Scales of prefixes, and in this order their names (`kil` and `micr` as in kilohm and microhm).
constexpr double scales[] = {1e-12, 1e-9, 1e-6, 1e-3, 1e3, 1e6, 1e9, 1e12};
constexpr std::string_view prefix_names[] = {" pico ",     " nano ",     " micro micr ", " milli ",
                                             " kilo kil ", " mega meg ", " giga ",       " tera "};

struct Spelled {
  Dimension dimension;
  double scale;
  std::string_view names;
  /// Eight prefixes, a blank where the unit has none, then eight further spellings of them.
  std::string_view symbols;
};

/// All in small letters, as in names of columns, `mhz` is a megahertz: nobody measures in millihertz.
constexpr Spelled units[] = {
    {Dimension::frequency, 1.0, "Hz HZ Hertz hertz HERTZ", "    kMGT    K   "},
    {Dimension::frequency, 1.0, "hz", "    kmgt    KMGT"},
    {Dimension::impedance, 1.0, "Ohm ohm Ohms ohms", "pnumkMGT    K   "},
    {Dimension::impedance, 1.0, "OHM OHMS", "pnumkMGTPNU K   "},
    {Dimension::admittance, 1.0, "S", "pnumk    NU K   "},
    {Dimension::admittance, 1.0, "s", "pnumk"},
    {Dimension::admittance, 1.0, "Siemens siemens Mho mho Mhos mhos", "pnumkMGT    K   "},
    {Dimension::admittance, 1.0, "SIEMENS MHO MHOS", "pnumkMGTPNU K   "},
    // Grad is no gigaradian.
    {Dimension::angle, radians_a_degree,
     "deg Deg DEG degs Degs DEGS degree Degree DEGREE degrees Degrees DEGREES", "pnum"},
    {Dimension::angle, 1.0, "rad Rad RAD radian Radian RADIAN radians Radians RADIANS", "pnum"},
    {Dimension::level, 1.0, "dB db DB dBohm dBOhm dBOHM dbohm DBOHM decibel decibels", ""},
    {Dimension::other, 1.0,
     "V A W F H C K N m g % VA va Pa pa volt volts Volt Volts Vpp vpp Vrms vrms bar dBm dbm min "
     "sec "
     "Sec",
     "pnumkMGT    K   "}};

std::optional<double> scale_of_symbol(std::string_view prefix, std::string_view symbols) {
  const std::size_t at = prefix.size() == 1 ? symbols.find(prefix) : std::string_view::npos;
  return at == std::string_view::npos ? std::nullopt
                                      : std::optional(scales[at % std::size(scales)]);
}

std::optional<double> scale_of_name(std::string_view prefix) {
  const auto* const found =
      std::find_if(std::begin(prefix_names), std::end(prefix_names),
                   [&](std::string_view each) { return is_among(lower_case(prefix), each); });
  return found == std::end(prefix_names) ? std::nullopt
                                         : std::optional(scales[found - prefix_names]);
}

/// 10^3, 10**3, 1e3, 1000; nothing of what is no whole power of ten.
std::optional<double> power_of_ten(const std::string& text) {
  const std::size_t mark = std::min(text.find_first_of("^*"), text.size());
  const std::size_t power = std::min(text.find_first_not_of("^*", mark), text.size());
  const auto factor = number_of(text.substr(0, mark));
  const auto exponent = power < text.size() ? number_of(text.substr(power)) : 1.0;
  if (!factor || !exponent || (power < text.size() && *factor != 10.0)) {
    return std::nullopt;
  }
  const double digits = std::log10(*factor) * *exponent;
  constexpr double most = 15.0;
  return std::abs(digits - std::round(digits)) < 1e-9 && std::abs(digits) <= most
             ? std::optional(std::pow(10.0, std::round(digits)))
             : std::nullopt;
}

}  // namespace

std::optional<Unit> unit_of_word(std::string_view word) {
  std::optional<Unit> found;
  std::size_t longest = 0;
  for (const Spelled& each : units) {
    for (const Cell& name : cells_of(each.names, ' ')) {
      const std::size_t size = name.text.size();
      if (size <= longest || size > word.size() || word.substr(word.size() - size) != name.text) {
        continue;
      }
      const std::string_view prefix = word.substr(0, word.size() - size);
      auto scale = prefix.empty() ? 1.0 : scale_of_symbol(prefix, each.symbols);
      if (!scale && size > 1 && !each.symbols.empty()) {
        scale = scale_of_name(prefix);
      }
      if (scale) {
        found = Unit{each.dimension, *scale * each.scale};
        longest = size;
      }
    }
  }
  return found;
}

std::optional<Unit> unit_of_text(std::string_view text) {
  // A power of ten or 1/, a word, and ^-1 or a power.
  static const std::string power =
      R"((?:[*xX] *)?([0-9.]+(?:[eE][+-]?[0-9]+)?(?:(?:\^|\*\*)[+-]?[0-9]+)?) *)";
  static const process::RegularExpression form(
      "(?:" + power + R"((?:[*xX] *)?|(1 */ *))?([A-Za-z%]+) *(?:(\^?-1)|)" + power + ")?");
  constexpr std::size_t longest = 60;
  text = trimmed(text);
  const process::Match part =
      text.size() > longest ? process::Match() : form.match(std::string(text));
  if (part.empty()) {
    return std::nullopt;
  }
  const auto unit = unit_of_word(part[3]);
  const auto before = part[1].empty() ? 1.0 : power_of_ten(part[1]);
  const auto behind = part[5].empty() ? 1.0 : power_of_ten(part[5]);
  if (!unit || !before || !behind) {
    return std::nullopt;
  }
  if (part[2].empty() && part[4].empty()) {
    return Unit{unit->dimension, unit->scale * *before * *behind};
  }
  const bool is_siemens = unit->dimension == Dimension::impedance && part[1].empty() &&
                          part[2].empty() != part[4].empty();
  return is_siemens ? std::optional(Unit{Dimension::admittance, 1.0 / unit->scale}) : std::nullopt;
}

std::string_view known_units() {
  return "Hz, deg, rad, ohm, S with a prefix from p to T or a power of ten, dB";
}

}  // namespace sonoglide::identify
