#include "host_sim/studies/identify/impedance/sweep_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <string_view>
#include <utility>

#include "host_sim/studies/identify/impedance/circuit.hpp"

namespace sonoglide::identify::impedance {
namespace {

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

/// Words of letters, their case kept, with names for signs that stand for words.
std::vector<std::string> words_of(std::string name) {
  for (const auto& [sign, word] :
       std::initializer_list<std::pair<const char*, const char*>>{{"\u03a9", " ohm "},
                                                                  {"\u2126", " ohm "},
                                                                  {"\u03b8", " theta "},
                                                                  {"\u03c6", " phi "},
                                                                  {"\u00b0", " deg "},
                                                                  {"\u00b5", "u"},
                                                                  {"\u03bc", "u"},
                                                                  {"''", " im "},
                                                                  {"|", " abs "}}) {
    replace_all(name, sign, word);
  }
  replace_all(name, "'", " re ");
  std::vector<std::string> words;
  bool inside = false;
  for (const char each : name) {
    const bool letter = std::isalpha(static_cast<unsigned char>(each)) != 0;
    if (letter && !inside) {
      words.emplace_back();
    }
    if (letter) {
      words.back() += each;
    }
    inside = letter;
  }
  return words;
}

std::string lower(std::string_view text) {
  std::string lower_text(text);
  for (char& each : lower_text) {
    each = static_cast<char>(std::tolower(static_cast<unsigned char>(each)));
  }
  return lower_text;
}

struct UnitName {
  const char* name;  ///< in small letters
  double scale;
};

constexpr UnitName frequency_units[] = {{"hz", 1.0}, {"khz", 1e3}, {"mhz", 1e6}, {"ghz", 1e9}};
constexpr UnitName angle_units[] = {{"deg", two_pi / 360.0},
                                    {"degree", two_pi / 360.0},
                                    {"degrees", two_pi / 360.0},
                                    {"rad", 1.0},
                                    {"radian", 1.0},
                                    {"radians", 1.0},
                                    {"mrad", 1e-3}};
constexpr UnitName impedance_units[] = {{"ohm", 1.0}, {"ohms", 1.0}, {"kohm", 1e3}, {"kohms", 1e3}};
constexpr UnitName admittance_units[] = {{"s", 1.0},   {"siemens", 1.0}, {"ms", 1e-3}, {"us", 1e-6},
                                         {"ns", 1e-9}, {"mho", 1.0},     {"ks", 1e3}};

/// Units that a wrong capital makes out of others, 10⁹ off.
bool is_ambiguous_unit(const std::string& word) {
  return word == "mHz" || word == "MS";
}

template <std::size_t Count>
bool take_unit(const std::string& word, const UnitName (&units)[Count], NamedColumn& column) {
  if (is_ambiguous_unit(word)) {
    return false;
  }
  for (const UnitName& each : units) {
    if (lower(word) == each.name) {
      column.scale = each.scale;
      column.has_unit = true;
      return true;
    }
  }
  return false;
}

bool is_one_of(const std::string& word, std::initializer_list<const char*> names) {
  return std::any_of(names.begin(), names.end(), [&](const char* each) { return word == each; });
}

void set(NamedColumn& column, Role role, bool is_admittance) {
  column.role = role;
  column.is_admittance = is_admittance;
  column.names_its_subject = true;
}

/// A word that names a part of an impedance or an admittance by itself.
bool take_part(const std::string& word, NamedColumn& column) {
  if (is_one_of(word, {"r", "rs", "resistance", "zre", "zreal", "rez"})) {
    set(column, Role::real, false);
  } else if (is_one_of(word, {"x", "xs", "reactance", "zim", "zimag", "imz"})) {
    set(column, Role::imaginary, false);
  } else if (is_one_of(word, {"g", "gp", "conductance", "yre", "yreal", "rey"})) {
    set(column, Role::real, true);
  } else if (is_one_of(word, {"b", "bp", "susceptance", "yim", "yimag", "imy"})) {
    set(column, Role::imaginary, true);
  } else if (is_one_of(word, {"zmag", "zmod", "zabs", "absz"})) {
    set(column, Role::magnitude, false);
  } else if (is_one_of(word, {"ymag", "ymod", "yabs", "absy"})) {
    set(column, Role::magnitude, true);
  } else if (is_one_of(word, {"zphase", "zang", "zarg", "zphi", "ztheta", "zphz"})) {
    set(column, Role::phase, false);
  } else if (is_one_of(word, {"yphase", "yang", "yarg", "yphi", "ytheta"})) {
    set(column, Role::phase, true);
  } else {
    return false;
  }
  return true;
}

Role role_of(const std::string& word) {
  if (is_one_of(word, {"abs", "mag", "magnitude", "modulus", "mod"})) {
    return Role::magnitude;
  }
  if (is_one_of(word, {"phase", "theta", "th", "phi", "arg", "argument", "angle", "ang"})) {
    return Role::phase;
  }
  if (is_one_of(word, {"re", "real"})) {
    return Role::real;
  }
  if (is_one_of(word, {"im", "imag", "imaginary"})) {
    return Role::imaginary;
  }
  return Role::none;
}

bool take_subject(const std::string& word, NamedColumn& column) {
  if (is_one_of(word, {"z", "impedance", "imp"})) {
    column.names_its_subject = true;
    return true;
  }
  if (is_one_of(word, {"y", "admittance", "adm"})) {
    column.names_its_subject = true;
    column.is_admittance = true;
    return true;
  }
  return false;
}

bool take_electrical_unit(const std::string& word, NamedColumn& column) {
  if (word == "MOhm" || word == "Mohm" || word == "MOHM" || word == "MOhms") {
    column.scale = 1e6;
  } else if (word == "mOhm" || word == "mohm") {
    column.scale = 1e-3;
  } else if (!take_unit(word, impedance_units, column)) {
    if (!take_unit(word, admittance_units, column)) {
      return false;
    }
    column.is_admittance = true;
  }
  column.has_unit = true;
  column.names_its_subject = true;
  return true;
}

/// Units of what is neither an impedance nor an admittance, an angle or a frequency, in small
/// letters.
constexpr std::initializer_list<const char*> foreign_units = {
    "v", "mv", "ma", "ua", "w", "mw", "va", "uf", "nf", "pf", "mh", "uh", "mm"};

/// S11, s_11, S21.
bool is_scattering_parameter(const std::string& name) {
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool begins = i == 0 || std::isalnum(static_cast<unsigned char>(name[i - 1])) == 0;
    if (begins && std::tolower(static_cast<unsigned char>(name[i])) == 's') {
      const std::size_t next = name.find_first_not_of('_', i + 1);
      return next != std::string::npos && std::isdigit(static_cast<unsigned char>(name[next])) != 0;
    }
  }
  return false;
}

/// Whether a name is of what a network analyser measures beside impedances: S11, a gain, a
/// reflection.
bool is_foreign(const std::string& name, const std::vector<std::string>& words) {
  return is_scattering_parameter(name) ||
         std::any_of(words.begin(), words.end(), [](const std::string& each) {
           return is_equivalent_element(each) ||
                  is_one_of(lower(each), {"gain", "transmission", "reflection", "gamma", "loss",
                                          "vswr", "swr", "attenuation", "voltage", "current",
                                          "power", "capacitance", "inductance"});
         });
}

bool is_frequency(const std::vector<std::string>& words) {
  const std::string first = words.empty() ? std::string() : lower(words.front());
  return is_one_of(first, {"f", "freq", "frequency", "hz", "khz", "mhz", "ghz"}) ||
         std::any_of(words.begin(), words.end(), [](const std::string& each) {
           return is_one_of(lower(each), {"freq", "frequency"});
         });
}

}  // namespace

bool is_equivalent_element(const std::string& word) {
  return is_one_of(lower(word), {"cp", "cs", "lp", "ls", "rp", "q", "d"});
}

double NamedColumn::value(double cell) const {
  constexpr double decibels_a_decade = 20.0;
  return scale * (decibel ? std::pow(10.0, cell / decibels_a_decade) : cell);
}

NamedColumn read_name(const std::string& name, std::string& unknown_unit) {
  NamedColumn column;
  const std::vector<std::string> words = words_of(name);
  const bool frequency = is_frequency(words);
  unknown_unit.clear();
  if (!frequency && is_foreign(name, words)) {
    return column;
  }
  for (const std::string& word : words) {
    const std::string small = lower(word);
    if (frequency) {
      column.role = Role::frequency;
      take_unit(word, frequency_units, column);
    } else if (role_of(small) != Role::none) {
      column.role = role_of(small);
    } else if (small == "db") {
      column.decibel = true;
    } else if (!take_subject(small, column) && !take_part(small, column) &&
               !take_unit(word, angle_units, column)) {
      take_electrical_unit(word, column);
    }
  }
  const bool bare_subject = column.role == Role::none && column.names_its_subject;
  if (bare_subject) {
    column.role = Role::magnitude;
  }
  if (column.decibel && !column.names_its_subject) {
    column.role = Role::none;  // of what, is not said
  }
  if (column.role == Role::imaginary && !name.empty() && name.front() == '-') {
    column.scale = -column.scale;
  }
  if (column.role != Role::none && !column.has_unit && !column.decibel && words.size() > 1 &&
      (is_ambiguous_unit(words.back()) || is_one_of(lower(words.back()), foreign_units))) {
    unknown_unit = words.back();
    return column;
  }
  const std::vector<std::string> unit = words_of(unit_in_brackets(name));
  const bool recognised = column.has_unit || column.decibel || unit.empty() ||
                          column.role == Role::none || role_of(lower(unit.front())) != Role::none ||
                          is_one_of(lower(unit.front()), {"z", "y", "x", "r", "g", "b"});
  unknown_unit = recognised ? std::string() : unit_in_brackets(name);
  return column;
}

double SweepColumns::phase_scale(const std::vector<double>& phases,
                                 std::vector<std::string>& warnings) const {
  if (rectangular || !second || second->has_unit) {
    return second ? second->scale : 1.0;
  }
  double most = 0.0;
  for (const double each : phases) {
    most = std::max(most, std::abs(each));
  }
  constexpr double most_in_radians = 3.2;
  const bool radians = most <= most_in_radians;
  warnings.push_back(fmt::format(
      "The phase has no unit in its name; as its largest value is {:.4g} it is taken for {}.", most,
      radians ? "radians" : "degrees"));
  return radians ? 1.0 : two_pi / 360.0;
}

namespace {

std::vector<NamedColumn> named_columns(const MeasuredTable& table) {
  std::vector<NamedColumn> columns;
  for (std::size_t i = 0; i < table.names().size(); ++i) {
    std::string unknown_unit;
    columns.push_back(read_name(table.names()[i], unknown_unit));
    columns.back().index = i;
    if (!unknown_unit.empty()) {
      throw table.heading_error(
          fmt::format("\"{}\": \"{}\" is no unit of it; allowed: Hz, kHz, MHz, GHz; deg, rad; ohm, "
                      "kohm, Mohm, S, mS, uS, dB",
                      table.names()[i], unknown_unit));
    }
  }
  return columns;
}

void require_different(const MeasuredTable& table, const std::vector<NamedColumn>& columns) {
  for (const NamedColumn& one : columns) {
    for (std::size_t i = 0; i < one.index; ++i) {
      const NamedColumn& other = columns[i];
      if (one.role != Role::none && one.role == other.role &&
          one.is_admittance == other.is_admittance) {
        throw table.heading_error(
            fmt::format("\"{}\" and \"{}\" are the same; allowed: one of them", table.names()[i],
                        table.names()[one.index]));
      }
    }
  }
}

std::optional<NamedColumn> find(const std::vector<NamedColumn>& columns, Role role,
                                std::optional<bool> admittance) {
  for (const NamedColumn& each : columns) {
    // A phase need not say of what.
    const bool subject = !admittance || each.is_admittance == *admittance ||
                         (role == Role::phase && !each.names_its_subject);
    if (each.role == role && subject &&
        (each.names_its_subject || role == Role::phase || role == Role::frequency ||
         !admittance.value_or(false))) {
      return each;
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<SweepColumns> find_columns(const MeasuredTable& table) {
  const std::vector<NamedColumn> columns = named_columns(table);
  require_different(table, columns);
  const auto frequency = find(columns, Role::frequency, std::nullopt);
  if (!frequency) {
    throw table.heading_error(
        fmt::format("no column is a frequency among {}; allowed: a name as frequency_Hz",
                    fmt::join(table.names(), ", ")));
  }
  std::vector<SweepColumns> found;
  for (const bool admittance : {false, true}) {
    const char* subject = admittance ? "an admittance" : "an impedance";
    for (const bool rectangular : {false, true}) {
      const auto one = find(columns, rectangular ? Role::real : Role::magnitude, admittance);
      const auto other = find(columns, rectangular ? Role::imaginary : Role::phase, admittance);
      if (one && other) {
        found.push_back(
            {*frequency, *one, other, rectangular, admittance,
             fmt::format("{} of {}",
                         rectangular ? "real and imaginary part" : "magnitude and phase",
                         subject)});
      }
    }
  }
  for (const bool admittance : {false, true}) {
    if (const auto one = find(columns, Role::magnitude, admittance)) {
      found.push_back(
          {*frequency, *one, std::nullopt, false, admittance,
           fmt::format("the magnitude of {}", admittance ? "an admittance" : "an impedance")});
    }
  }
  if (found.empty()) {
    throw table.heading_error(
        fmt::format("no columns of an impedance or admittance among {}; allowed: magnitude with or "
                    "without phase, or real and imaginary part, as "
                    "impedance_magnitude_ohm,impedance_phase_deg; S11 is "
                    "read from Touchstone files, .s1p",
                    fmt::join(table.names(), ", ")));
  }
  return found;
}

}  // namespace sonoglide::identify::impedance
