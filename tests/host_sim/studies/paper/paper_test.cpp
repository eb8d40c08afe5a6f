/// The paper's figures against numbers that are known without this program.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "firmware/friction/dahl_friction_ratio.hpp"
#include "firmware/friction/normal_vibration_ratio.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/scene/solver_methods.hpp"
#include "host_sim/scene_file/reader.hpp"
#include "host_sim/studies/paper/contact_laws.hpp"
#include "host_sim/studies/paper/experiments.hpp"
#include "host_sim/studies/paper/figures.hpp"
#include "host_sim/studies/paper/runs.hpp"
#include "tests/common/constants/pi.hpp"
#include "tests/common/csv/csv.hpp"

namespace sonoglide::paper::paper_test {
namespace {

double at(const csv::Table& table, const std::string& column, double velocity_ratio) {
  return table.rows().at(index_of(velocity_ratio)).number(column);
}

bool has_claim(const Figure& figure, ClaimStatus verdict, const std::string& numbers) {
  return std::any_of(figure.claims.begin(), figure.claims.end(), [&](const Claim& claim) {
    return claim.verdict == verdict && claim.numbers.find(numbers) != std::string::npos;
  });
}

TEST(PaperTest, Figure2HasTheClosedFormsAndAPlantThatAgreesOnItsSteadyOrbit) {
  const csv::Table figure(figure_2().csv);
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
  // (2/pi) (asin r + sqrt(1 - r^2)/r).
  EXPECT_NEAR(at(figure, "coulomb_dissipation_steady", 0.1), 6.398, 5e-4);
  EXPECT_NEAR(at(figure, "coulomb_dissipation_steady", 0.5), 1.4360, 5e-5);
  EXPECT_NEAR(at(figure, "coulomb_dissipation_steady", 0.9), 1.0212, 5e-5);
  // tests/firmware/plant/data/reference_open_loop.csv has more than 20 digits.
  EXPECT_NEAR(at(figure, "dahl_from_rest", 0.5), 0.656900288709659, 1e-9);
}

TEST(PaperTest, Figure4SaysThatTheFreeVibrationIsTheStarts) {
  const Figure figure = figure_4();
  EXPECT_EQ(figure.claims.size(), 2U);
  EXPECT_TRUE(has_claim(figure, ClaimStatus::depends, "the free vibration of an undamped plant"));
  const csv::Table motion(figure.csv);
  EXPECT_EQ(motion.numbers("displacement_from_rest_m").front(), 0.0);
  const std::vector<double> velocity = motion.numbers("velocity_steady_m_per_s");
  EXPECT_NEAR(*std::max_element(velocity.begin(), velocity.end()), 0.0534, 1e-4);
}

// sqrt(Ks/m)/2π is 12.979 kHz; the lines of the spectrum are 30 Hz apart.
TEST(PaperTest, Figure6NamesDriveNaturalFrequencyAndTheirCombinations) {
  const Figure figure = figure_6();
  EXPECT_TRUE(has_claim(figure, ClaimStatus::depends, "f (60.00 kHz)"));
  EXPECT_TRUE(has_claim(figure, ClaimStatus::depends, "fn (12.99 kHz)"));
  EXPECT_TRUE(has_claim(figure, ClaimStatus::holds, "2f (120.00 kHz)"));
  EXPECT_TRUE(has_claim(figure, ClaimStatus::holds, "f - fn (47.01 kHz)"));
}

TEST(PaperTest, Figure7HasTheKnownRatiosOfTwoForces) {
  const csv::Table force(figure_7().csv);
  // Dahl numbers of 0.4045 and 2.023.
  EXPECT_NEAR(at(force, "force_384_N_friction_ratio_steady", 0.1), 0.14875, 5e-5);
  EXPECT_NEAR(at(force, "force_384_N_friction_ratio_steady", 0.5), 0.67494, 5e-5);
  EXPECT_NEAR(at(force, "force_384_N_friction_ratio_steady", 0.9), 0.97585, 5e-5);
  EXPECT_NEAR(at(force, "force_1920_N_friction_ratio_steady", 0.1), 0.08814, 5e-5);
  EXPECT_NEAR(at(force, "force_1920_N_friction_ratio_steady", 0.5), 0.48927, 5e-5);
  EXPECT_NEAR(at(force, "force_1920_N_friction_ratio_steady", 0.9), 0.94541, 5e-5);
}

TEST(PaperTest, Figures8And9HaveTheKnownTrends) {
  const csv::Table coefficient(figure_8().csv);
  EXPECT_NEAR(at(coefficient, "coefficient_0.05_friction_ratio_steady", 0.5), 0.626, 1e-3);
  EXPECT_NEAR(at(coefficient, "coefficient_0.2_friction_ratio_steady", 0.5), 0.691, 1e-3);
  const csv::Table mass(figure_9().csv);
  EXPECT_NEAR(at(mass, "mass_0.04_kg_friction_ratio_steady", 0.5), 0.695, 1e-3);
  EXPECT_NEAR(at(mass, "mass_0.1_kg_friction_ratio_steady", 0.5), 0.696, 1e-3);
}

TEST(PaperTest, Figure10HasNoReductionWithoutExcitation) {
  const csv::Table stiffness(figure_10().csv);
  EXPECT_NEAR(at(stiffness, "driven_560000_N_per_m_friction_ratio_steady", 0.5), 0.397, 1e-3);
  EXPECT_NEAR(at(stiffness, "undriven_560000_N_per_m_friction_ratio_steady", 0.05), 1.0, 1e-9);
}

TEST(PaperTest, Figure12HasTheKnownRatiosOfEveryLaw) {
  const csv::Table laws(figure_12().csv);
  const std::map<double, double> coulomb = {
      {0.1, 0.06377}, {0.3, 0.19397}, {0.5, 0.33333}, {0.8, 0.59033}, {0.95, 0.79783}};
  for (const auto& [ratio, known] : coulomb) {
    EXPECT_NEAR(at(laws, "coulomb_closed_form", ratio), known, 1e-5) << ratio;
    EXPECT_NEAR(at(laws, "coulomb_simulated", ratio), known, 1e-4) << ratio;
  }
  EXPECT_NEAR(at(laws, "dahl_simulated", 0.5), 0.67494, 5e-5);
  EXPECT_NEAR(at(laws, "transverse_closed_form", 0.1), 0.23442, 1e-5);
  EXPECT_NEAR(at(laws, "transverse_closed_form", 0.5), 0.64264, 1e-5);
  EXPECT_NEAR(at(laws, "transverse_closed_form", 1.0), 0.83463, 1e-5);
  // mu_eff = (2/pi) mu_s asin r - alpha Vt + beta (Vt^3 + 1.5 Vt v^2) over mu(Vt), at r = 0.5.
  const double v = 0.053429588879;
  const double undriven = 0.1 - 0.75 * 0.5 * v + 100.0 * std::pow(0.5 * v, 3);
  const double averaged =
      0.1 / 3.0 - 0.75 * 0.5 * v + 100.0 * (std::pow(0.5 * v, 3) + 0.75 * v * v * v);
  EXPECT_NEAR(at(laws, "stribeck_closed_form", 0.5), averaged / undriven, 1e-9);
  std::size_t checked = 0;
  for (const double ratio : velocity_ratios()) {
    if (ratio < 0.97 || ratio > 1.03) {  // the closed form ends vertically at 1
      EXPECT_NEAR(at(laws, "stribeck_simulated", ratio), at(laws, "stribeck_closed_form", ratio),
                  1e-4)
          << ratio;
      ++checked;
    }
  }
  EXPECT_EQ(checked + 1, velocity_ratios().size());
}

TEST(PaperTest, Figure12SaysWhichOfItsClaimsCannotBeChecked) {
  const Figure figure = figure_12();
  EXPECT_TRUE(has_claim(figure, ClaimStatus::depends, "in no source at hand"));
  EXPECT_TRUE(has_claim(figure, ClaimStatus::holds, "15 % of the friction left at 0.1 mm/s"));
  EXPECT_TRUE(has_claim(figure, ClaimStatus::does_not_hold, "so that this is no test"));
}

// Coulomb says 1 - (2/pi) asin(Vt/v), v = 2 pi 26 kHz 0.35 um, whatever is not published; with the
// softest contact, kappa to 0, Dahl says 1 - pi r / (2 (sqrt(1 - r^2) + r asin r)).
TEST(PaperTest, MeasurementsStandBesideWhatTheLawsSay) {
  using tests::pi;
  EXPECT_NEAR(luo_peak_m_per_s(), 2.0 * pi * 26e3 * 0.35e-6, 1e-12);
  const double r = 1e-4 / luo_peak_m_per_s();
  const std::vector<MeasurementComparison> all = compare_measurements();
  ASSERT_EQ(all.size(), 6U);
  const std::vector<Prediction>& slow = all[1].predictions;
  const double coulomb = 1.0 - 2.0 / pi * std::asin(r);
  EXPECT_NEAR(slow[0].reduction.least, coulomb, 1e-12);
  EXPECT_NEAR(slow[0].difference(all[1].measurement), coulomb - 0.85, 1e-12);
  EXPECT_NEAR(slow[1].reduction.least,
              1.0 - pi * r / (2.0 * (std::sqrt(1.0 - r * r) + r * std::asin(r))), 1e-6);
  EXPECT_NEAR(slow[1].reduction.most, coulomb, 1e-12);
  for (const MeasurementComparison& each : all) {
    for (const Prediction& prediction : each.predictions) {
      EXPECT_LE(prediction.reduction.least, prediction.reduction.most);
      EXPECT_GE(prediction.reduction.least, 0.0);
      EXPECT_LE(prediction.reduction.most, 1.0);
      const bool meets = prediction.reduction.least <= each.measurement.reduction.most &&
                         each.measurement.reduction.least <= prediction.reduction.most;
      EXPECT_EQ(prediction.difference(each.measurement) == 0.0, meets) << prediction.law;
    }
  }
}

// As far as friction does not bend the motion, by Fc/Fe = 1e-4 here: with a ten-thousandth of the
// friction they agree.
TEST(PaperTest, TheSceneOfTheSlowSliderIsTheClosedForm) {
  scene::Scene luo = scene_file::read_text(luo_text(), "luo_2024.toml");
  EXPECT_NEAR(dahl_number(luo), 1.0, 1e-12);
  const double ratio = vibration_ratio(luo);
  const double known = friction::dahl_friction_ratio(1e-4 / luo_peak_m_per_s(), 1.0);
  EXPECT_NEAR(ratio, known, 2e-3 * known);
  // LuGre has it as a limit.
  // One spring holds on to 1 - Kt X/Fc, but for what the slide adds.
  EXPECT_NEAR(luo_iwan(1e-4).least, 0.1, 5e-3);
  EXPECT_NEAR(luo_iwan(1e-4).most, 1.0, 0.02);
  const Interval lugre = luo_lugre(1e-4);
  EXPECT_LT(lugre.least, 1.0 - ratio);
  EXPECT_GT(lugre.most, 1.0 - ratio);
  luo.friction.normal_force_N *= 1e-4;
  luo.friction.contact_stiffness_N_per_m *= 1e-4;
  EXPECT_NEAR(vibration_ratio(luo), known, 1e-9);
}

TEST(PaperTest, ANormallyVibratingContactGivesBothMeasuredReductions) {
  const double velocities_m_per_s[] = {20.3e-3, 87e-3};
  const double reductions[] = {0.62, 0.29};
  const NormalContact contact = dong_contact();
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(
        friction::normal_vibration_ratio(contact.amplitude_ratio,
                                         velocities_m_per_s[i] / contact.critical_velocity_m_per_s),
        1.0 - reductions[i], 1e-9);
  }
}

TEST(PaperTest, Table2IsThePapersSolverAndMissesTheRatioByItsPrintedStep) {
  const scene::Scene scene = scene_file::read_text(table_2_text(), "table_2.toml");
  EXPECT_EQ(scene.solver.method, scene::method_of<scene::solvers::Rk4>);
  const double ratio = loop::power_ratios(scene, loop::run(scene).whole).friction_ratio;
  // tests/firmware/plant/data/reference_open_loop.csv has the ratio.
  EXPECT_NEAR(ratio / 0.656900288709659, 1.0, 1e-7);
  EXPECT_GT(std::abs(ratio / 0.656900288709659 - 1.0), 1e-8);
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

// Table 1 at a velocity ratio of 0.5: Ks X^2/4 with X = Fe/(m w^2 - Ks), over phi_iu = phi_fu - rho
// times the work of the friction limit in a period, rho by the closed form.
TEST(PaperTest, TheSpringHoldsFarMoreThanAPeriodPutsIn) {
  const Balance b = steady_balance(0.5);
  const double held_J = 0.25 * 133e6 * std::pow(1.4172638629e-7, 2);
  EXPECT_NEAR(b.average_potential, held_J, 1e-4 * held_J);
  const double limit_J = 0.01962 * 0.026714794 / 60e3;
  const double input_J = limit_J * (b.true_dissipation_ratio - 0.674948666956629);
  EXPECT_NEAR(b.average_potential / b.ultrasonic_input, held_J / input_J, 0.01 * held_J / input_J);
  EXPECT_TRUE(has_claim(figure_9(), ClaimStatus::does_not_hold, "the spring holds"));
}

TEST(PaperTest, StatementsBesideTheFiguresAreJudgedToo) {
  EXPECT_TRUE(has_claim(figure_3(), ClaimStatus::depends, "1000 Runge-Kutta steps"));
  EXPECT_TRUE(has_claim(figure_10(), ClaimStatus::does_not_hold, "So less friction"));
  EXPECT_TRUE(has_claim(figure_12(), ClaimStatus::holds, "takes 1.000000 times as much"));
}

TEST(PaperTest, TheFaultsHaveTheirKnownEffects) {
  const std::vector<PrintedFault> all = faults();
  ASSERT_EQ(all.size(), 6U);
  EXPECT_NE(all[0].effect.find("0.51"), std::string::npos) << all[0].effect;
  EXPECT_NE(all[3].effect.find("0.6749 on the steady orbit"), std::string::npos) << all[3].effect;
}

/// The multipliers undriven and of the averaged slope by hand: exp(-F'/(2 m f)).
TEST(PaperTest, DitherIsJudgedOnAMassOnABelt) {
  const std::vector<Claim> claims = dither_claims();
  ASSERT_EQ(claims.size(), 3U);
  for (const Claim& each : claims) {
    EXPECT_EQ(each.verdict, ClaimStatus::holds) << each.numbers;
  }
  EXPECT_NE(claims[0].numbers.find("by 1.004990 undriven and by 0.998200 under"), std::string::npos)
      << claims[0].numbers;
  EXPECT_NE(claims[2].numbers.find("147.1 mm/s (147.1 mm/s) at 2 kHz"), std::string::npos)
      << claims[2].numbers;
}

}  // namespace
}  // namespace sonoglide::paper::paper_test
