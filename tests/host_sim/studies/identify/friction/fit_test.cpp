/// Laws fitted to data whose law is known from elsewhere.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "host_sim/studies/identify/friction/comparison.hpp"
#include "host_sim/studies/identify/text_file.hpp"

namespace sonoglide::identify::friction::fit_test {
namespace {

void silent(double /*fraction*/) {}

Comparison compared(
    const std::string& rows, const std::vector<std::string>& laws,
    const std::string& columns = "velocity_ratio,sliding_velocity_m_per_s,friction_ratio\n") {
  const scene_file::Source source{"f.csv", columns + rows};
  return compare(read_readings(source), laws, silent);
}

const LawFit& law(const Comparison& comparison, const std::string& title) {
  return *std::find_if(comparison.laws.begin(), comparison.laws.end(),
                       [&](const LawFit& each) { return each.law.title == title; });
}

const Estimate& parameter(const LawFit& fit, const std::string& name) {
  return *std::find_if(fit.parameters.begin(), fit.parameters.end(),
                       [&](const Estimate& each) { return each.name == name; });
}

/// (2/pi) asin of the ratio, known to five digits.
const std::string coulomb_rows =
    "0.1,0.01,0.06377\n0.3,0.03,0.19397\n0.5,0.05,0.33333\n0.8,0.08,0.59033\n"
    "0.95,0.095,0.79783\n";

TEST(FrictionFit, CoulombsTableIsCoulombs) {
  const Comparison comparison = compared(coulomb_rows, {});
  EXPECT_LT(law(comparison, "Coulomb").residual_rms, 5e-6);
  // A stiff Dahl contact is one: its stiffness has no upper end.
  const LawFit& dahl = law(comparison, "Dahl");
  EXPECT_LT(dahl.residual_rms, 1e-3);
  EXPECT_TRUE(std::isnan(parameter(dahl, "dahl_number_at_largest_vibration").high_95));
}

TEST(FrictionFit, TransverseTableIsTransverse) {
  const Comparison comparison = compared("0.1,0.01,0.23442\n0.5,0.05,0.64264\n1.0,0.1,0.83463\n",
                                         {"coulomb", "transverse_coulomb", "dahl"});
  EXPECT_EQ(comparison.best().law.law, "transverse_coulomb");
  EXPECT_LT(comparison.best().residual_rms, 5e-6);
}

/// At a Dahl number of 2.023, known to five digits; noise is rounding.
TEST(FrictionFit, DahlsTableGivesItsDahlNumber) {
  const Comparison comparison =
      compared("0.1,0.01,0.08814\n0.5,0.05,0.48927\n0.9,0.09,0.94541\n", {"dahl", "coulomb"});
  const Estimate& number = parameter(comparison.best(), "dahl_number_at_largest_vibration");
  EXPECT_EQ(comparison.best().law.law, "dahl");
  EXPECT_NEAR(number.value, 2.023, 0.001);
  EXPECT_LT(number.low_95, 2.0235);
  EXPECT_GT(number.high_95, 2.0225);
}

/// Forces give the friction limit; without frequency no stiffness.
TEST(FrictionFit, ForcesGiveTheFrictionLimit) {
  const Comparison comparison =
      compared("0.1,0.01,0.17628\n0.5,0.05,0.97854\n0.9,0.09,1.89082\n", {"dahl"},
               "velocity_ratio,sliding_velocity_m_per_s,friction_force_N\n");
  EXPECT_NEAR(parameter(comparison.best(), "friction_limit_N").value, 2.0, 1e-3);
  EXPECT_EQ(comparison.best().parameters.front().name,
            "dahl_number_per_vibration_velocity_s_per_m");
}

TEST(FrictionFit, RunsAreCountedExactly) {
  // 2 runs of 4 + 4: 2 of C(8, 4) = 70 arrangements.
  EXPECT_NEAR(runs_probability({1, 1, 1, 1, -1, -1, -1, -1}), 2.0 / 70.0, 1e-12);
  EXPECT_NEAR(runs_probability({1, -1, 1, -1, 1, -1, 1, -1}), 1.0, 1e-12);
  // 3 runs of 2 + 1: all but the 2 of 3 arrangements with 2.
  EXPECT_NEAR(runs_probability({1, 1, -1}), 2.0 / 3.0, 1e-12);
}

TEST(FrictionFit, ConstantReadingsAndAlikeOnesAreNoTrap) {
  const Comparison constant =
      compared("2,0.2,1\n3,0.3,1\n4,0.4,1\n5,0.5,1\n6,0.6,1\n", {"dahl", "coulomb"});
  EXPECT_LT(constant.best().residual_rms, 1e-12);
  const LawFit& dahl = law(constant, "Dahl");
  EXPECT_TRUE(std::isnan(dahl.parameters.front().low_95));
  EXPECT_TRUE(std::isnan(dahl.parameters.front().high_95));
  const Comparison alike = compared("0.5,0.05,0.5\n0.5,0.05,0.5\n0.5,0.05,0.5\n", {"dahl"});
  EXPECT_NEAR(alike.best().residual_rms, 0.0, 1e-6);
}

/// Readings that agree to their last digit have an interval that holds their own value.
TEST(FrictionFit, ReadingsWithoutScatterHaveAnIntervalAroundTheirValue) {
  for (const char* rows :
       {"0.5,0.05,0.4\n0.5,0.05,0.4\n0.5,0.05,0.4\n0.5,0.05,0.4\n",
        "0.5,0.05,0.41234567890123456\n0.5,0.05,0.41234567890123456\n0.5,0.05,0."
        "41234567890123456\n",
        "0.1,0.01,0.08814\n0.1,0.01,0.08814\n0.5,0.05,0.48927\n0.5,0.05,0.48927\n"}) {
    const Comparison comparison = compared(rows, {"dahl", "iwan"});
    for (const LawFit& each : comparison.laws) {
      for (const Estimate& estimate : each.parameters) {
        if (std::isfinite(estimate.value)) {
          EXPECT_FALSE(estimate.low_95 > estimate.value) << rows << estimate.name;
          EXPECT_FALSE(estimate.high_95 < estimate.value) << rows << estimate.name;
        }
      }
    }
    const Estimate& best = comparison.best().parameters.front();
    EXPECT_LT(best.low_95, best.value) << rows;
    EXPECT_GT(best.high_95, best.value) << rows;
  }
}

/// Eight times one reading tell one number, whatever their scatter.
TEST(FrictionFit, RepeatedReadingsDetermineNoMoreParameters) {
  std::string rows;
  for (const char* force : {"0.50", "0.51", "0.49", "0.50", "0.52", "0.48", "0.50", "0.51"}) {
    rows += std::string("0.5,0.05,") + force + "\n";
  }
  const Comparison comparison =
      compared(rows, {"coulomb", "dahl", "stribeck", "lugre"},
               "velocity_ratio,sliding_velocity_m_per_s,friction_force_N\n");
  EXPECT_EQ(comparison.best().law.law, "coulomb");
  EXPECT_TRUE(std::isfinite(comparison.best().parameters.front().low_95));
  for (const char* title : {"Dahl", "Stribeck", "LuGre"}) {
    const LawFit& each = law(comparison, title);
    EXPECT_FALSE(each.is_determined) << title;
    EXPECT_EQ(verdict(comparison, each),
              "not determined: fewer different readings than parameters");
    for (const Estimate& estimate : each.parameters) {
      EXPECT_TRUE(std::isnan(estimate.value)) << estimate.name;
      EXPECT_TRUE(std::isnan(estimate.low_95) && std::isnan(estimate.high_95)) << estimate.name;
    }
  }
  const Comparison alone =
      compared(rows, {"lugre"}, "velocity_ratio,sliding_velocity_m_per_s,friction_force_N\n");
  EXPECT_NE(to_json(alone)["cannot_tell"].dump().find(
                "LuGre: 5 parameters are not determined by readings of one velocity"),
            std::string::npos);
}

/// Residuals beyond any scale of the standard errors are told as that, by no library's words.
TEST(FrictionFit, TinyStandardErrorsAreExceeded) {
  const std::string columns =
      "velocity_ratio,sliding_velocity_m_per_s,friction_ratio,friction_ratio_standard_error\n";
  const Comparison comparison = compared(
      "0.1,0.01,0.06,1e-12\n0.5,0.05,0.40,1e-12\n0.9,0.09,0.71,1e-12\n", {"coulomb"}, columns);
  EXPECT_EQ(comparison.best().chi_square_probability, 0.0);
  EXPECT_TRUE(comparison.best().exceeds_standard_errors());
  EXPECT_THROW(compared("0.1,0.01,0.06,1e-200\n0.5,0.05,0.4,1e-200\n", {"coulomb"}, columns),
               scene_file::SceneError);
}

TEST(FrictionFit, ASceneThatRunWouldRefuseIsNotWritten) {
  const std::string columns =
      "sliding_velocity_m_per_s,vibration_velocity_m_per_s,frequency_Hz,friction_ratio\n";
  const Comparison comparison =
      compared("1e-10,2e-10,1,0.33\n1e-10,3e-10,1,0.22\n", {"coulomb"}, columns);
  EXPECT_TRUE(comparison.scene.empty());
  EXPECT_NE(
      comparison.warnings.back().find("No scene.toml is written, because run would refuse it: "
                                      "plant.mass_kg: "),
      std::string::npos)
      << comparison.warnings.back();
  EXPECT_FALSE(compared(coulomb_rows, {"coulomb"}).scene.empty());
}

Candidate candidate(const Readings& readings, const std::string& title) {
  const std::vector<Candidate> all = candidates(extent_of(readings));
  return *std::find_if(all.begin(), all.end(),
                       [&](const Candidate& each) { return each.title == title; });
}

/// A law on 20 velocity ratios from 0.05 to 1.2 and 25 kHz, with Gaussian noise.
Readings readings_of(const std::string& title, const std::vector<double>& shape, double noise) {
  Readings readings;
  readings.have_frequency = true;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 20; ++i) {
    constexpr double vibration_m_per_s = 0.2;
    const double ratio = 0.05 + (1.2 - 0.05) * i / 19.0;
    readings.rows.push_back({ratio * vibration_m_per_s, vibration_m_per_s, 25e3, 0.0, 0.0});
  }
  const Candidate law = candidate(readings, title);
  for (Reading& row : readings.rows) {
    const MeanFriction mean = law.mean(law, row, shape);
    row.friction = mean.driven / mean.undriven + noise * normal(random);
  }
  return readings;
}

constexpr double per_amplitude_per_m = 25e3 * 6.283185307179586 / 0.2;

/// What cannot be told names by how much vibrations that are larger than stated move Kt/Fc.
TEST(FrictionFit, AnErrorOfTheVibrationsScaleIsTold) {
  const double truth = 2.0 * per_amplitude_per_m;
  Readings readings = readings_of("Dahl", {truth}, 0.002);
  for (Reading& row : readings.rows) {
    row.vibration_m_per_s /= 1.03;
  }
  const Comparison comparison = compare(readings, {"dahl"}, silent);
  const Estimate& found = comparison.best().parameters.front();
  EXPECT_GT(found.value, 1.05 * truth);
  const std::string told = comparison.best().open.back();
  const std::string before = "Were the vibrations 1 % larger than stated: " + found.name + " ";
  const std::size_t at = told.find(before);
  ASSERT_NE(at, std::string::npos) << told;
  EXPECT_NE(told.find("smaller", at), std::string::npos) << told;
  const double percent = std::stod(told.substr(at + before.size()));
  EXPECT_NEAR(found.value * (1.0 - 0.03 * percent), truth, 0.02 * truth) << told;
}

/// Readings at random, far beyond what is measured: a fit, or a refusal with its place.
TEST(FrictionFit, RandomReadingsAreFittedOrRefused) {
  std::mt19937_64 random(3);
  const auto within = [&](double low, double high) {
    return low + (high - low) * std::uniform_real_distribution<double>(0.0, 1.0)(random);
  };
  const auto number = [&](double low, double high) {
    return random() % 8 == 0 ? std::pow(10.0, within(-310.0, 10.0)) : within(low, high);
  };
  const std::vector<std::string> laws = {"coulomb", "dahl", "iwan", "stribeck", "normal_coulomb"};
  int fitted = 0;
  for (int set = 0; set < 240; ++set) {
    const bool forces = set % 2 == 0;
    std::string text =
        std::string("sliding_velocity_m_per_s;vibration_velocity_m_per_s;friction_") +
        (forces ? "force_N;friction_force_standard_error_N\n"
                : "ratio;friction_ratio_standard_error\n");
    for (int row = 0; row <= set % 7; ++row) {
      text += fmt::format("{};{};{};{}\n", number(0.01, 0.2),
                          random() % 6 == 0 ? 0.0 : number(0.1, 0.2), number(0.1, 1.0),
                          number(1e-3, 0.1));
    }
    const scene_file::Source source{"f.csv", text};
    try {
      const Comparison comparison = compare(
          read_readings(source), {laws[static_cast<std::size_t>(set) % laws.size()]}, silent);
      ++fitted;
      for (const Estimate& each : comparison.best().parameters) {
        EXPECT_FALSE(each.low_95 > each.value || each.high_95 < each.value) << each.name << text;
      }
    } catch (const scene_file::SceneError& error) {
      EXPECT_NE(std::string(error.what()).find("; allowed: "), std::string::npos) << error.what();
    }
  }
  EXPECT_GT(fitted, 30);
}

/// LuGre with Fs/Fc = 1 and no viscous friction is Dahl, and all that are stiff are Coulomb.
TEST(FrictionFit, ALawThatContainsAnotherFitsNoWorse) {
  const std::vector<double> dahl = {2.0 * per_amplitude_per_m};
  const std::vector<double> stribeck = {0.3, 1.0};
  for (const double noise : {0.0, 0.01}) {
    for (const Readings& readings :
         {readings_of("Dahl", dahl, noise), readings_of("Coulomb", {}, noise),
          readings_of("Stribeck", stribeck, noise)}) {
      const auto rms = [&](const std::string& title) {
        return fit(readings, candidate(readings, title)).residual_rms;
      };
      constexpr double ends_of_ranges = 2e-4;
      EXPECT_LE(rms("LuGre"), rms("Dahl") + ends_of_ranges) << noise;
      for (const char* title : {"Dahl", "Iwan, 1 spring", "Iwan, 8 springs", "Stribeck"}) {
        EXPECT_LE(rms(title), rms("Coulomb") + ends_of_ranges) << title << noise;
      }
    }
  }
}

TEST(FrictionFit, LuGreIsFittedToItsNoise) {
  for (const std::vector<double>& shape :
       {std::vector<double>{2.0 * per_amplitude_per_m, 0.5, 0.05, 1e-6},
        std::vector<double>{0.5 * per_amplitude_per_m, 1.0, 0.1, 1.0},
        std::vector<double>{20.0 * per_amplitude_per_m, 0.3, 0.02, 1e-6}}) {
    const Readings readings = readings_of("LuGre", shape, 0.003);
    const LawFit found = fit(readings, candidate(readings, "LuGre"));
    EXPECT_LT(found.residual_rms, 0.004) << shape.front();
    EXPECT_FALSE(found.fails());
  }
}

/// Residuals of rounding are no pattern, whatever their signs.
TEST(FrictionFit, AnExactFitDoesNotFail) {
  const std::string ones =
      "1.5,0.3,1\n1.6,0.32,1\n1.7,0.34,1\n1.8,0.36,1\n1.9,0.38,1\n2,0.4,1\n2.1,0.42,1\n"
      "2.2,0.44,1\n2.3,0.46,1\n2.4,0.48,1\n";
  const Comparison comparison = compared(ones, {"coulomb", "dahl", "iwan", "stribeck"});
  for (const LawFit& each : comparison.laws) {
    EXPECT_FALSE(each.fails()) << each.law.title;
    EXPECT_EQ(each.misfit, 0.0) << each.law.title;
  }
  EXPECT_TRUE(comparison.warnings.empty());
  const Readings exact = readings_of("Dahl", {2.0 * per_amplitude_per_m}, 0.0);
  for (const char* title : {"Dahl", "LuGre"}) {
    EXPECT_FALSE(fit(exact, candidate(exact, title)).fails()) << title;
  }
}

/// With `repeats` of each reading that scatter by less than the two digits that are written.
Comparison compared_rounded(double truth, const std::vector<std::size_t>& velocities, int repeats) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> scatter(0.0, 5e-4);
  std::string rows;
  const Readings exact = readings_of("Dahl", {truth}, 0.0);
  for (const std::size_t velocity : velocities) {
    const Reading& row = exact.rows[velocity];
    for (int repeat = 0; repeat < repeats; ++repeat) {
      rows += fmt::format("{},{},25e3,{:.2f}\n", row.sliding_m_per_s, row.vibration_m_per_s,
                          row.friction + (repeats > 1 ? scatter(random) : 0.0));
    }
  }
  return compared(
      rows, {"dahl"},
      "sliding_velocity_m_per_s,vibration_velocity_m_per_s,frequency_Hz,friction_ratio\n");
}

/// They are off alike, and their rounding is no pattern.
TEST(FrictionFit, RepeatsThatAreRoundedAlikeTellNoMoreThanOne) {
  constexpr int sets = 20;
  for (const auto& velocities : {std::vector<std::size_t>{7}, std::vector<std::size_t>{2, 7, 12}}) {
    int held = 0;
    for (int set = 0; set < sets; ++set) {
      const double truth = per_amplitude_per_m * std::pow(10.0, set / 19.0 - 0.5);
      const Comparison comparison = compared_rounded(truth, velocities, 20);
      const Estimate& found = comparison.best().parameters.front();
      held += found.low_95 <= truth && truth <= found.high_95 ? 1 : 0;
      EXPECT_FALSE(comparison.best().fails()) << set;
    }
    EXPECT_GE(held, sets - 2);
  }
}

/// Nor less: their interval is about that of one reading each, whose last digits are others.
TEST(FrictionFit, RepeatsThatAreRoundedAlikeTellNoLessThanOne) {
  std::vector<std::size_t> all(17);
  std::iota(all.begin(), all.end(), std::size_t{0});
  const double truth = 0.4 * per_amplitude_per_m;
  const Estimate once = compared_rounded(truth, all, 1).best().parameters.front();
  const Comparison repeated = compared_rounded(truth, all, 5);
  const Estimate often = repeated.best().parameters.front();
  const double width = std::log(once.high_95 / once.low_95);
  EXPECT_LT(std::log(often.high_95 / often.low_95), 2.0 * width);
  EXPECT_GT(std::log(often.high_95 / often.low_95), 0.5 * width);
  EXPECT_NEAR(std::log(often.value / once.value), 0.0, width);
  EXPECT_NE(repeated.warnings.front().find("their mean counts as one reading"), std::string::npos);
}

/// The verdict has room: chi square is a column only where standard errors are stated.
TEST(FrictionPage, HasOneLawAndNoColumnOfDashes) {
  const output::Page without = page(compared(coulomb_rows, {"coulomb"}), "x");
  EXPECT_NE(without.lead.find("against one law."), std::string::npos) << without.lead;
  EXPECT_EQ(without.tables.at(0).header.back(), "P(runs)");
  const output::Page with =
      page(compared("0.1,0.01,0.06,0.01\n0.5,0.05,0.33,0.01\n0.9,0.09,0.71,0.01\n", {"coulomb"},
                    "velocity_ratio,sliding_velocity_m_per_s,friction_ratio,"
                    "friction_ratio_standard_error\n"),
           "x");
  EXPECT_EQ(with.tables.at(0).header.back(), "P(chi²)");
  EXPECT_EQ(with.tables.at(0).rows.at(0).size(), with.tables.at(0).header.size());
}

Comparison of_example(const std::string& name, const std::vector<std::string>& laws) {
  const scene_file::Source source = read_text(std::string(EXAMPLES) + "/" + name);
  return compare(read_readings(source), laws, silent);
}

/// Coulomb, Dahl and Stribeck leave next to nothing at 0.1 mm/s, whatever their parameters.
TEST(FrictionFit, OfLuoNoLawFitsButAnElasticStick) {
  const std::vector<std::string> along = {"coulomb", "dahl", "iwan", "stribeck"};
  const Comparison comparison = of_example("luo_2024.csv", along);
  for (const char* title : {"Coulomb", "Dahl", "Stribeck"}) {
    EXPECT_TRUE(law(comparison, title).exceeds_standard_errors()) << title;
    EXPECT_GT(law(comparison, title).residual_rms, 0.1) << title;
  }
  EXPECT_EQ(comparison.best().law.law, "iwan");
  EXPECT_FALSE(comparison.best().exceeds_standard_errors());
  EXPECT_NE(comparison.cannot_tell.front().find("Which law it is"), std::string::npos);
}

/// Any critical velocity from a fiftieth of the vibration on fits; a stiffness within a factor of two.
TEST(FrictionFit, WhatIsOpenByMoreThanAFactorOfTenHasNoValueAndAReason) {
  const Comparison comparison = of_example("luo_2024.csv", {"normal_coulomb"});
  const Estimate open = parameter(comparison.best(), "critical_velocity_per_vibration_velocity");
  EXPECT_TRUE(std::isnan(open.value)) << open.value;
  EXPECT_TRUE(std::isfinite(open.low_95));
  EXPECT_TRUE(
      std::isfinite(parameter(comparison.best(), "amplitude_ratio_at_largest_vibration").value));
  const nlohmann::ordered_json json = to_json(comparison);
  EXPECT_TRUE(json["parameters"]["critical_velocity_per_vibration_velocity"]["value"].is_null());
  EXPECT_NE(json["cannot_tell"].dump().find("critical_velocity_per_vibration_velocity: no upper "
                                            "end of its interval"),
            std::string::npos);
  EXPECT_NE(json["cannot_tell"].dump().find("open by more than a factor of ten"),
            std::string::npos);
}

/// As many parameters as readings: met exactly, and no test.
TEST(FrictionFit, TwoReadingsOfDongAreNoTestOfTheNormalLaw) {
  const Comparison comparison = of_example("dong_dapino_2015.csv", {"normal_coulomb"});
  EXPECT_LT(comparison.best().residual_rms, 1e-6);
  for (const Estimate& each : comparison.best().parameters) {
    EXPECT_TRUE(std::isnan(each.low_95) && std::isnan(each.high_95)) << each.name;
  }
  const nlohmann::ordered_json json = to_json(comparison);
  EXPECT_EQ(json["law"], "normal_coulomb");
  EXPECT_TRUE(json["parameters"]["amplitude_ratio_at_largest_vibration"]["low_95"].is_null());
  EXPECT_NE(json["cannot_tell"].dump().find("no test of the law"), std::string::npos);
}

}  // namespace
}  // namespace sonoglide::identify::friction::fit_test
