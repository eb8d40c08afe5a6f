/// The paper's figures against numbers that are known without this program.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "host_sim/paper/balance.hpp"
#include "host_sim/paper/faults.hpp"
#include "host_sim/paper/figures.hpp"
#include "host_sim/paper/ratio_curve.hpp"

namespace sonoglide::paper {
namespace {

using Columns = std::map<std::string, std::vector<double>>;

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> all;
  std::istringstream stream(line + ',');
  for (std::string cell; std::getline(stream, cell, ',');) {
    all.push_back(cell);
  }
  return all;
}

Columns columns(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> names = cells(line);
  Columns columns;
  while (std::getline(lines, line)) {
    const std::vector<std::string> values = cells(line);
    EXPECT_EQ(values.size(), names.size()) << line;
    for (std::size_t i = 0; i < names.size(); ++i) {
      columns[names[i]].push_back(std::stod(values[i]));
    }
  }
  return columns;
}

double at(const Columns& columns, const std::string& name, double velocity_ratio) {
  return columns.at(name).at(index_of(velocity_ratio));
}

bool has_claim(const Figure& figure, Verdict verdict, const std::string& numbers) {
  return std::any_of(figure.claims.begin(), figure.claims.end(), [&](const Claim& claim) {
    return claim.verdict == verdict && claim.numbers.find(numbers) != std::string::npos;
  });
}

TEST(PaperTest, Figure2HasTheClosedFormsAndAPlantThatAgreesOnItsSteadyOrbit) {
  const Columns figure = columns(figure_2().csv);
  EXPECT_NEAR(at(figure, "coulomb_closed_form", 0.1), 0.06377, 1e-5);
  EXPECT_NEAR(at(figure, "coulomb_closed_form", 0.95), 0.79783, 1e-5);
  EXPECT_NEAR(at(figure, "dahl_closed_form", 0.1), 0.14875, 1e-5);
  EXPECT_NEAR(at(figure, "dahl_closed_form", 0.5), 0.67494, 1e-5);
  EXPECT_NEAR(at(figure, "dahl_closed_form", 0.9), 0.97585, 1e-5);
  for (const double ratio : velocity_ratios()) {
    EXPECT_NEAR(at(figure, "dahl_steady", ratio), at(figure, "dahl_closed_form", ratio), 1e-3);
    EXPECT_NEAR(at(figure, "coulomb_steady", ratio), at(figure, "coulomb_closed_form", ratio),
                1e-3);
  }
  // tests/plant/data/reference_open_loop.csv has more than 20 digits.
  EXPECT_NEAR(at(figure, "dahl_from_rest", 0.5), 0.656900288709659, 1e-9);
}

TEST(PaperTest, Figure4SaysThatTheFreeVibrationIsTheStarts) {
  const Figure figure = figure_4();
  EXPECT_EQ(figure.claims.size(), 2U);
  EXPECT_TRUE(has_claim(figure, Verdict::depends, "the free vibration of an undamped plant"));
  const Columns motion = columns(figure.csv);
  EXPECT_EQ(motion.at("displacement_from_rest_m").front(), 0.0);
  const std::vector<double>& velocity = motion.at("velocity_steady_m_per_s");
  EXPECT_NEAR(*std::max_element(velocity.begin(), velocity.end()), 0.0534, 1e-4);
}

// sqrt(Ks/m)/2π is 12.979 kHz; the lines of the spectrum are 30 Hz apart.
TEST(PaperTest, Figure6NamesDriveNaturalFrequencyAndTheirCombinations) {
  const Figure figure = figure_6();
  EXPECT_TRUE(has_claim(figure, Verdict::depends, "f (60.00 kHz)"));
  EXPECT_TRUE(has_claim(figure, Verdict::depends, "fn (12.99 kHz)"));
  EXPECT_TRUE(has_claim(figure, Verdict::holds, "2f (120.00 kHz)"));
  EXPECT_TRUE(has_claim(figure, Verdict::holds, "f - fn (47.01 kHz)"));
}

TEST(PaperTest, Figure7HasTheKnownRatiosOfTwoForces) {
  const Columns force = columns(figure_7().csv);
  EXPECT_NEAR(at(force, "force_384_N_friction_ratio_steady", 0.5), 0.6749, 1e-4);
  EXPECT_NEAR(at(force, "force_1920_N_friction_ratio_steady", 0.5), 0.4893, 1e-4);
  EXPECT_NEAR(at(force, "force_1920_N_friction_ratio_steady", 0.1), 0.0881, 1e-4);
}

TEST(PaperTest, Figures8And9HaveTheKnownTrends) {
  const Columns coefficient = columns(figure_8().csv);
  EXPECT_NEAR(at(coefficient, "coefficient_0.05_friction_ratio_steady", 0.5), 0.626, 1e-3);
  EXPECT_NEAR(at(coefficient, "coefficient_0.2_friction_ratio_steady", 0.5), 0.691, 1e-3);
  const Columns mass = columns(figure_9().csv);
  EXPECT_NEAR(at(mass, "mass_0.04_kg_friction_ratio_steady", 0.5), 0.695, 1e-3);
  EXPECT_NEAR(at(mass, "mass_0.1_kg_friction_ratio_steady", 0.5), 0.696, 1e-3);
}

TEST(PaperTest, Figure10HasNoReductionWithoutExcitation) {
  const Columns stiffness = columns(figure_10().csv);
  EXPECT_NEAR(at(stiffness, "driven_560000_N_per_m_friction_ratio_steady", 0.5), 0.397, 1e-3);
  EXPECT_NEAR(at(stiffness, "undriven_560000_N_per_m_friction_ratio_steady", 0.05), 1.0, 1e-9);
}

TEST(PaperTest, TheTrueBalanceClosesAndThePrintedOneDoesNot) {
  for (const Balance& balance : balances()) {
    EXPECT_LE(balance.true_residual, 1e-9) << balance.start << ' ' << balance.velocity_ratio;
    EXPECT_GT(balance.printed_residual, 0.5) << balance.start << ' ' << balance.velocity_ratio;
    // (6) and (7) less what (11) leaves out of them.
    EXPECT_NEAR(balance.average_kinetic + balance.average_potential - balance.kinetic_sliding,
                balance.average_stored, 1e-12 * balance.average_stored);
  }
  const Balance half = steady_balance(0.5);
  EXPECT_NEAR(half.printed_dissipation_ratio, -1700.0, 20.0);
  // Without damping the mean potential energy is that of the amplitude Fe/|Ks - m w^2|.
  EXPECT_NEAR(half.average_potential, 0.25 * 133e6 * std::pow(1.4172e-7, 2), 1e-9);
}

TEST(PaperTest, TheFaultsHaveTheirKnownEffects) {
  const std::vector<Fault> all = faults();
  ASSERT_EQ(all.size(), 6U);
  EXPECT_NE(all[0].effect.find("0.51"), std::string::npos) << all[0].effect;
  EXPECT_NE(all[3].effect.find("0.6749 on the steady orbit"), std::string::npos) << all[3].effect;
}

}  // namespace
}  // namespace sonoglide::paper
