/// Units of headings: every spelling of a unit, its prefix and its power of ten, in every place.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "host_sim/studies/identify/impedance/sweep.hpp"
#include "host_sim/studies/identify/impedance/sweep_columns.hpp"

namespace sonoglide::identify::impedance {
namespace {

struct Spelling {
  std::string text;
  double scale;
};

/// Each pair of one of these and one of those: the texts in a row, the scales multiplied.
std::vector<Spelling> product(const std::vector<Spelling>& one,
                              const std::vector<Spelling>& other) {
  std::vector<Spelling> all;
  for (const Spelling& a : one) {
    for (const Spelling& b : other) {
      all.push_back({a.text + b.text, a.scale * b.scale});
    }
  }
  return all;
}

const std::vector<Spelling> powers = {{"10^3 ", 1e3},
                                      {"10^-6 ", 1e-6},
                                      {"1e3 ", 1e3},
                                      {"1E-6 ", 1e-6},
                                      {"\u00d710\u207b\u2076 ", 1e-6},
                                      {"x10^-6 ", 1e-6},
                                      {"x 10^3 ", 1e3},
                                      {"10\u00b3 ", 1e3},
                                      {"10\xb3 ", 1e3},
                                      {"10**3 ", 1e3},
                                      {"10^{3} ", 1e3},
                                      {"1000 ", 1e3},
                                      {"\u00b7 10^3 ", 1e3},
                                      {"10^3\u00b7", 1e3},
                                      {"10^3 \u00d7 ", 1e3},
                                      {"10^+3 ", 1e3},
                                      {"", 1.0}};

const std::vector<Spelling> ohms = product({{"", 1.0},
                                            {"k", 1e3},
                                            {"K", 1e3},
                                            {"M", 1e6},
                                            {"m", 1e-3},
                                            {"u", 1e-6},
                                            {"\u00b5", 1e-6},
                                            {"\u03bc", 1e-6},
                                            {"G", 1e9},
                                            {"n", 1e-9},
                                            {"kilo", 1e3},
                                            {"Mega", 1e6},
                                            {"mega", 1e6},
                                            {"Meg", 1e6},
                                            {"meg", 1e6},
                                            {"milli", 1e-3},
                                            {"k ", 1e3},
                                            {"M ", 1e6},
                                            {"kilo-", 1e3}},
                                           {{"Ohm", 1.0},
                                            {"ohm", 1.0},
                                            {"ohms", 1.0},
                                            {"Ohms", 1.0},
                                            {"\u03a9", 1.0},
                                            {"\u2126", 1.0},
                                            {"\\Omega", 1.0}});

const std::vector<Spelling> siemens =
    product({{"", 1.0},
             {"k", 1e3},
             {"m", 1e-3},
             {"u", 1e-6},
             {"\u00b5", 1e-6},
             {"\u03bc", 1e-6},
             {"n", 1e-9},
             {"p", 1e-12}},
            {{"S", 1.0}, {"siemens", 1.0}, {"Siemens", 1.0}, {"mho", 1.0}, {"\u2127", 1.0}});

const std::vector<Spelling> hertz =
    product({{"", 1.0},
             {"k", 1e3},
             {"M", 1e6},
             {"G", 1e9},
             {"T", 1e12},
             {"kilo", 1e3},
             {"mega", 1e6},
             {"Mega", 1e6},
             {"giga", 1e9},
             {"k ", 1e3}},
            {{"Hz", 1.0}, {"HZ", 1.0}, {"Hertz", 1.0}, {"hertz", 1.0}});

constexpr double degree = 3.14159265358979323846 / 180.0;
const std::vector<Spelling> angles = {{"deg", degree},    {"Deg", degree},     {"DEG", degree},
                                      {"degree", degree}, {"degrees", degree}, {"\u00b0", degree},
                                      {"\u00ba", degree}, {"\xb0", degree},    {"^\\circ", degree},
                                      {"rad", 1.0},       {"RAD", 1.0},        {"radian", 1.0},
                                      {"radians", 1.0},   {"mrad", 1e-3},      {"millirad", 1e-3}};

/// Places of a unit, `#` stands for it; powers of ten may stand in the first of them only.
const std::vector<std::string> places_of_powers = {" (#)", "(#)",  " [#]", "[#]",          " {#}",
                                                   "/#",   " / #", ", #",  "\uff08#\uff09"};
const std::vector<std::string> places_of_words = {"_#",   " #",  " in #",    " (#)-data",
                                                  " <#>", ": #", "\u00a0[#]"};

std::string at_place(const std::string& place, const std::string& unit) {
  std::string text = place;
  return text.replace(text.find('#'), 1, unit);
}

struct Kind {
  std::vector<std::string> names;
  Role role;
  Subject subject;
  std::vector<Spelling> units;
};

const std::vector<Kind> kinds = {
    {{"f", "frequency", "Freq.", "Frequency"}, Role::frequency, Subject::unknown, hertz},
    {{"|Z|", "Z", "impedance_magnitude", "Mag(Z)", "absz"},
     Role::magnitude,
     Subject::impedance,
     ohms},
    {{"R", "Re(Z)", "Z'", "Zreal"}, Role::real, Subject::impedance, ohms},
    {{"X", "Im(Z)", "Z''", "Z\"", "Z_imag"}, Role::imaginary, Subject::impedance, ohms},
    {{"|Y|", "admittance"}, Role::magnitude, Subject::admittance, siemens},
    {{"G", "Re(Y)"}, Role::real, Subject::admittance, siemens},
    {{"B", "Yimag"}, Role::imaginary, Subject::admittance, siemens},
    {{"phase", "\u03b8", "Phase(Z)", "arg Y", "\u2220Z"}, Role::phase, Subject::unknown, angles}};

void expect_scale(const Kind& kind, const std::string& name, double scale) {
  const ColumnName read = read_name(name);
  EXPECT_EQ(read.role, kind.role) << name << " | " << read.not_understood;
  EXPECT_NEAR(read.scale / scale, 1.0, 1e-12) << name;
  EXPECT_TRUE(read.has_unit) << name;
  if (kind.role != Role::phase) {
    EXPECT_EQ(read.subject, kind.subject) << name;
  }
}

/// 28,000 headings.
TEST(ColumnName, EverySpellingOfAUnitIsItsScale) {
  for (const Kind& kind : kinds) {
    for (const std::string& name : kind.names) {
      for (const Spelling& unit : kind.units) {
        for (const std::string& place : places_of_words) {
          expect_scale(kind, name + at_place(place, unit.text), unit.scale);
        }
        for (const std::string& place : places_of_powers) {
          expect_scale(kind, name + at_place(place, unit.text), unit.scale);
        }
      }
      for (const Spelling& unit : product(powers, kind.units)) {
        expect_scale(kind, name + at_place(places_of_powers[unit.text.size() % 9], unit.text),
                     unit.scale);
      }
    }
    if (::testing::Test::HasFailure()) {
      break;
    }
  }
}

/// What is no unit of a column is refused in every place, with its name, and never dropped.
TEST(ColumnName, WhatIsNoUnitIsRefusedInEveryPlace) {
  const auto error_of = [](const std::string& heading) -> std::string {
    try {
      read_sweep({"m.csv", heading + "\n1\t2\t3\n"});
    } catch (const scene_file::SceneError& error) {
      return error.what();
    }
    return "no error";
  };
  const std::vector<std::string> of_all = {"furlong",      "kfurlong", "kilo",   "Ohm m",
                                           "Ohm/sq",       "%",        "2 kOhm", "10^2.5 Ohm",
                                           "10^3 furlong", "V",        "Ohm Hz"};
  std::vector<std::string> places = places_of_words;
  places.insert(places.end(), places_of_powers.begin(), places_of_powers.end());
  const auto expect_refused = [&](const std::string& before, const std::string& name,
                                  const std::string& unit, const std::string& behind) {
    for (const std::string& place : places) {
      const std::string heading = before + name + at_place(place, unit) + behind;
      const std::string error = error_of(heading);
      EXPECT_EQ(error.find(fmt::format("m.csv:1:{}: heading: ", before.size() + 1)), 0U)
          << heading << " | " << error;
      EXPECT_NE(error.find("is no unit"), std::string::npos) << heading << " | " << error;
    }
  };
  std::vector<std::string> units = of_all;
  for (const std::string& unit : units) {
    expect_refused("", "f", unit, "\t|Z| (Ohm)\tphase (deg)");
    expect_refused("f\t", "|Z|", unit, "\tphase (deg)");
    expect_refused("f\t", "G", unit, "\tB (S)");
    expect_refused("f\t|Z|\t", "phase", unit, "");
  }
  for (const char* unit : {"mHz", "uHz", "Ohm", "deg"}) {
    expect_refused("", "frequency", unit, "\t|Z|\tphase (deg)");
  }
  for (const char* unit : {"S", "mS", "Hz", "rad", "mV", "H"}) {
    expect_refused("f\t", "impedance_magnitude", unit, "\tphase (deg)");
  }
  for (const char* unit : {"MS", "GS", "Ohm", "kOhm", "A"}) {
    expect_refused("f\t", "conductance", unit, "\tB (S)");
  }
  for (const char* unit : {"Hz", "Ohm", "ms", "\u00b0C", "gon", "Grad", "krad", "rad/pi"}) {
    expect_refused("f\t|Z|\t", "phase", unit, "");
  }
}

TEST(ColumnName, NamesOfOtherQuantitiesHaveNoRole) {
  for (const char* name : {"S11 (dB)",
                           "s_11 phase",
                           "Gain (dB)",
                           "Return Loss(dB)",
                           "VSWR",
                           "Cp (F)",
                           "C (F)",
                           "|V| (V)",
                           "|I|",
                           "|Iac| (A)",
                           "Temperature (\u00b0C)",
                           "time/s",
                           "Pt",
                           "index",
                           "Magnitude (dB)",
                           "<Ewe>/V",
                           "Humidity (%)",
                           "Amplitude in Vpp",
                           "I Range",
                           "#"}) {
    EXPECT_EQ(read_name(name).role, Role::none) << name;
    EXPECT_EQ(read_name(name).not_understood, "") << name;
  }
}

TEST(ColumnName, ANamedPrefixOrAReciprocalOhmIsASiemens) {
  EXPECT_EQ(read_name("G (nanoSiemens)").scale, 1e-9);
  EXPECT_EQ(read_name("G MicroSiemens").scale, 1e-6);
  for (const char* name : {"Re(Y)/Ohm-1", "G (Ohm^-1)", "G (\u03a9\u207b\u00b9)", "G (1/Ohm)"}) {
    EXPECT_EQ(read_name(name).role, Role::real) << name;
    EXPECT_EQ(read_name(name).scale, 1.0) << name;
  }
  EXPECT_NEAR(read_name("G (1/kOhm)").scale, 1e-3, 1e-15);
  EXPECT_NEAR(read_name("G (k\u03a9\u207b\u00b9)").scale, 1e-3, 1e-15);
}

}  // namespace
}  // namespace sonoglide::identify::impedance
