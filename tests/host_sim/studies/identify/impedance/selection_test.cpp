#include "host_sim/studies/identify/impedance/selection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "host_sim/loop/plant/failure.hpp"
#include "host_sim/studies/identify/impedance/study.hpp"
#include "synthetic.hpp"

namespace sonoglide::identify::impedance {
namespace {

void expect_near(const Circuit& found, const Circuit& truth, double tolerance) {
  const Mode& mode = found.modes.front();
  const Mode& expected = truth.modes.front();
  EXPECT_NEAR(found.clamped_capacitance_F / truth.clamped_capacitance_F, 1.0, tolerance);
  EXPECT_NEAR(mode.conductance_S / expected.conductance_S, 1.0, tolerance);
  EXPECT_NEAR(mode.quality() / expected.quality(), 1.0, tolerance);
  EXPECT_NEAR(mode.resonance_Hz / expected.resonance_Hz, 1.0, tolerance / expected.quality());
}

bool has_lead(const CircuitFit& fit) {
  return fit.parts.has(Part::lead_resistance) || fit.parts.has(Part::lead_inductance);
}

/// Without errors the circuit comes back, whatever the quality factor, the coupling and the sweep,
/// with few readings across the resonance.
TEST(Selection, FindsExactCircuitsWithoutStartValues) {
  for (const double quality : {5.0, 30.0, 1e3, 1e5}) {
    for (const double ratio : {1e-3, 0.05, 0.5}) {
      const double f = 40e3;
      const Circuit truth{2e-9, 0.003, {{two_pi * f * ratio * 2e-9 * quality, f, f / quality}}};
      const double span = std::max(8.0 / quality, 0.2 * ratio);
      Sweep sweep = exact_sweep(truth, f * std::max(0.3, 1.0 - span), f * (1.0 + span), 401);
      SCOPED_TRACE(testing::Message() << "Q " << quality << ", C1/C0 " << ratio);
      expect_near(select_circuit(sweep).fit.circuit, truth, 1e-5);
    }
  }
}

TEST(Selection, FindsThePublishedPieceInSeveralDecades) {
  const Circuit truth = published_piece();
  Sweep sweep{"", {}, {}, true, {}};
  for (int i = 0; i <= 4000; ++i) {
    const double f = 1e3 * std::pow(1e4, i / 4000.0);
    sweep.frequency_Hz.push_back(f);
    sweep.admittance_S.push_back(truth.admittance_S(f));
  }
  expect_near(select_circuit(sweep).fit.circuit, truth, 1e-6);
}

TEST(Selection, FindsThePublishedPieceInMagnitudesAlone) {
  const Circuit truth = published_piece();
  Sweep sweep = exact_sweep(truth, 110e3, 117e3, 201);
  for (auto& each : sweep.admittance_S) {
    each = std::abs(each);
  }
  sweep.has_phase = false;
  expect_near(select_circuit(sweep).fit.circuit, truth, 1e-6);
}

std::string refusal(const Sweep& sweep) {
  try {
    select_circuit(sweep);
  } catch (const loop::ComputationError& error) {
    return error.what();
  }
  return "";
}

void add_noise(Sweep& sweep, double level) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (auto& each : sweep.admittance_S) {
    each *= 1.0 + level * std::complex<double>(normal(random), normal(random));
  }
}

TEST(Selection, RefusesASweepWithoutAResonance) {
  Sweep capacitor = exact_sweep({2e-9, 0.01, {}}, 10e3, 20e3, 101);
  add_noise(capacitor, 1e-3);
  EXPECT_NE(refusal(capacitor).find("no resonance was found"), std::string::npos);
  const Circuit above{2e-9, 0.0, {{1e-2, 30e3, 100.0}}};
  Sweep flank = exact_sweep(above, 10e3, 28e3, 101);
  add_noise(flank, 1e-4);
  EXPECT_NE(refusal(flank).find("not in the sweep"), std::string::npos) << refusal(flank);
}

TEST(Selection, FindsThePublishedLangevinTransducer) {
  Sweep sweep = exact_sweep(published_langevin(), 27e3, 31.5e3, 201);
  disturb(sweep, 5e-3, 5e-3, 1);
  const Selection selected = select_circuit(sweep);
  expect_near(selected.fit.circuit, published_langevin(), 1e-2);
  EXPECT_EQ(selected.fit.parts.modes, 1);
  EXPECT_FALSE(has_lead(selected.fit));
}

/// Several modes hide each other: each is misfit to the fits without it.
TEST(Selection, SeesModesBesideEachOtherInAWideSweep) {
  Circuit two = published_langevin();
  two.modes.push_back({1.0 / 300.0, 40e3, 40e3 / 30.0});
  Circuit five{12e-9, 0.004, {}};
  for (int i = 0; i < 5; ++i) {
    five.modes.push_back({1.0 / 200.0, 30e3 + 2.5e3 * i, 100.0 / (two_pi * 20e-3)});
  }
  for (const auto& [truth, high_Hz] : {std::pair(two, 100e3), std::pair(five, 43e3)}) {
    Sweep sweep = exact_sweep(truth, truth.modes.size() == 2 ? 20e3 : 28e3, high_Hz, 600);
    disturb(sweep, 5e-3, 5e-3, 1);
    const CircuitFit fit = select_circuit(sweep).fit;
    ASSERT_EQ(fit.circuit.modes.size(), truth.modes.size());
    for (const Mode& each : truth.modes) {
      EXPECT_TRUE(std::any_of(fit.circuit.modes.begin(), fit.circuit.modes.end(),
                              [&](const Mode& m) {
                                return std::abs(m.resonance_Hz / each.resonance_Hz - 1.0) < 1e-3 &&
                                       std::abs(m.conductance_S / each.conductance_S - 1.0) < 0.03;
                              }))
          << each.resonance_Hz;
    }
  }
}

Estimate figure(const CircuitFit& fit, const std::string& name) {
  for (const Estimate& each : figures(fit)) {
    if (each.name == name) {
      return each;
    }
  }
  return {};
}

bool holds(const Estimate& estimate, double truth) {
  return estimate.low_95 <= truth && truth <= estimate.high_95;
}

/// In a sweep from 27 to 31.5 kHz a delay looks likelier than this lead.
TEST(Selection, SeesALead) {
  Circuit truth = published_langevin();
  truth.lead = {5.0, 1e-6};
  Sweep sweep = exact_sweep(truth, 15e3, 60e3, 600);
  disturb(sweep, 1e-3, 1e-3, 1);
  const CircuitFit fit = select_circuit(sweep).fit;
  EXPECT_TRUE(holds(figure(fit, "lead_resistance_ohm"), 5.0));
  EXPECT_TRUE(holds(figure(fit, "motional_resistance_ohm"), 175.0));
  EXPECT_NEAR(fit.circuit.lead.resistance_ohm, 5.0, 0.5);
  EXPECT_EQ(fit.parts.modes, 1);
}

TEST(Selection, SeesTheInductanceOfALeadWhereItMatters) {
  Circuit truth = published_langevin();
  truth.lead = {2.0, 3e-6};
  Sweep sweep{"", {}, {}, true, {}};
  for (int i = 0; i < 600; ++i) {
    const double f = 5e3 * std::pow(200.0, i / 599.0);
    sweep.frequency_Hz.push_back(f);
    sweep.admittance_S.push_back(truth.admittance_S(f));
  }
  disturb(sweep, 3e-3, 3e-3, 2);
  const CircuitFit fit = select_circuit(sweep).fit;
  EXPECT_NEAR(fit.circuit.lead.inductance_H, 3e-6, 0.2e-6);
  EXPECT_NEAR(fit.circuit.lead.resistance_ohm, 2.0, 0.2);
}

/// 40 kHz, Q 200, 300 uH in series without a resistance. An error of the phase is a rival of it.
TEST(Selection, SeesTheInductanceOfALeadAlone) {
  const double f = 40e3;
  Circuit truth{2e-9, 0.004, {{two_pi * f * 1e-10 * 200.0, f, f / 200.0}}};
  truth.lead = {0.0, 300e-6};
  int seen = 0;
  int held = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Sweep sweep = exact_sweep(truth, 39e3, 42e3, 301);
    disturb(sweep, 5e-3, 5e-3, seed);
    const CircuitFit fit = select_circuit(sweep).fit;
    if (fit.parts.has(Part::lead_inductance)) {
      ++seen;
      held += holds(figure(fit, "resonance_frequency_Hz"), f) &&
                      holds(figure(fit, "lead_inductance_H"), 300e-6)
                  ? 1
                  : 0;
    }
  }
  EXPECT_GE(seen, 17);
  EXPECT_GE(held, seen - 3);
}

const Unseen& unseen_part(const Selection& selected, Part part) {
  return *std::find_if(selected.unseen.begin(), selected.unseen.end(),
                       [&](const Unseen& each) { return each.part == part; });
}

/// One that is not seen shifts the figures as the selection tells.
TEST(Selection, TellsWhatAnInductanceThatIsNotSeenDoes) {
  const double f = 40e3;
  Circuit truth{2e-9, 0.004, {{two_pi * f * 1e-10 * 200.0, f, f / 200.0}}};
  truth.lead = {20.0, 50e-6};
  Sweep sweep = exact_sweep(truth, 39e3, 42e3, 301);
  disturb(sweep, 5e-3, 5e-3, 1);
  const Selection selected = select_circuit(sweep);
  ASSERT_FALSE(selected.fit.parts.has(Part::lead_inductance));
  const Unseen& unseen = unseen_part(selected, Part::lead_inductance);
  EXPECT_GT(unseen.most, 50e-6);
  const Mode& found = selected.fit.circuit.modes.front();
  const Eigen::Vector4d off = 50e-6 * unseen.off;
  EXPECT_NEAR(found.resonance_Hz / f - 1.0, off(2), 2e-5);
  EXPECT_NEAR(found.capacitance_F() / 1e-10 - 1.0, off(1) + off(3) - 2.0 * off(2), 3e-3);
  EXPECT_NEAR(found.resistance_ohm() * truth.modes.front().conductance_S - 1.0, -off(1), 6e-3);
  EXPECT_NEAR(selected.fit.circuit.clamped_capacitance_F / 2e-9 - 1.0, off(0), 3e-3);
}

/// How many of 20 sweeps of 200 readings have the motional resistance in its interval.
int holding_resistance(const Circuit& truth, double magnitude, double phase_rad) {
  int held = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Sweep sweep = exact_sweep(truth, 27e3, 31.5e3, 200);
    disturb(sweep, magnitude, phase_rad, seed);
    const Estimate found = figure(select_circuit(sweep).fit, "motional_resistance_ohm");
    held += holds(found, truth.modes.front().resistance_ohm()) ? 1 : 0;
  }
  return held;
}

/// One that readings of 1 % hardly tell from 0.
TEST(Selection, AllowsForALeadThatIsNotSeen) {
  Circuit truth = published_langevin();
  truth.lead = {1.0, 0.0};
  EXPECT_GE(holding_resistance(truth, 0.01, 0.01), 14);
  Sweep sweep = exact_sweep(published_langevin(), 27e3, 31.5e3, 200);
  disturb(sweep, 0.01, 0.01, 1);
  const double unseen_ohm = unseen_part(select_circuit(sweep), Part::lead_resistance).most;
  EXPECT_GT(unseen_ohm, 0.5);
  EXPECT_LT(unseen_ohm, 5.0);
}

TEST(Selection, APhaseThatScattersDoesNotShiftTheMagnitude) {
  int held = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Sweep sweep = exact_sweep(published_langevin(), 27e3, 31.5e3, 200);
    disturb(sweep, 0.003, 0.052, seed);
    held += holds(figure(select_circuit(sweep).fit, "clamped_capacitance_F"), 3.2e-9) ? 1 : 0;
  }
  EXPECT_GE(held, 17);
}

TEST(Selection, LeavesOutNothingOfGaussianErrors) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Sweep sweep = exact_sweep(published_langevin(), 20e3, 40e3, 401);
    disturb(sweep, 0.01, 0.01, seed);
    EXPECT_TRUE(select_circuit(sweep).left_out_Hz.empty()) << seed;
  }
}

/// A second mode across seven readings of a sweep over four decades.
TEST(Selection, ARunOfReadingsIsAModeAndNoStray) {
  Circuit truth = published_langevin();
  truth.modes.push_back({1.0 / 800.0, 85e3, 85e3 / 26.7});
  Sweep sweep{"", {}, {}, true, {}};
  for (int i = 0; i <= 800; ++i) {
    const double f = 1e3 * std::pow(1e4, i / 800.0);
    sweep.frequency_Hz.push_back(f);
    sweep.admittance_S.push_back(truth.admittance_S(f));
  }
  disturb(sweep, 5e-3, 5e-3, 1);
  const Selection selected = select_circuit(sweep);
  EXPECT_TRUE(selected.left_out_Hz.empty());
  ASSERT_EQ(selected.fit.parts.modes, 2);
  EXPECT_NEAR(selected.fit.circuit.modes[1].resonance_Hz, 85e3, 100.0);
}

/// A series lead bends the sweep as a mode outside of it would.
TEST(Selection, InventsNoModeOutsideTheSweep) {
  Circuit truth = published_piece();
  truth.lead = {3.0, 0.0};
  Sweep sweep = exact_sweep(truth, 110e3, 118e3, 200);
  disturb(sweep, 1e-3, 1e-3, 1);
  for (auto& each : sweep.admittance_S) {
    each = std::abs(each);
  }
  sweep.has_phase = false;
  for (const Mode& each : select_circuit(sweep).fit.circuit.modes) {
    EXPECT_GT(each.resonance_Hz, 110e3);
    EXPECT_LT(each.resonance_Hz, 118e3);
  }
}

TEST(Selection, RefusesASweepThatTheCircuitDoesNotDescribe) {
  Sweep sweep = exact_sweep(published_langevin(), 27e3, 31.5e3, 400);
  disturb(sweep, 1e-3, 1e-3, 1);
  for (std::size_t i = 0; i < sweep.frequency_Hz.size(); ++i) {
    sweep.admittance_S[i] *= std::exp(0.9 * std::sin(0.3 * static_cast<double>(i)));
  }
  EXPECT_NE(refusal(sweep).find("the circuit does not describe the sweep"), std::string::npos)
      << refusal(sweep);
}

TEST(Selection, SaysWhatAReversedSignAndAResistanceLookLike) {
  Sweep reversed = exact_sweep(published_langevin(), 27e3, 31.5e3, 200);
  disturb(reversed, 1e-3, 1e-3, 1);
  for (auto& each : reversed.admittance_S) {
    each = std::conj(each);
  }
  EXPECT_NE(refusal(reversed).find("the sign of the phase"), std::string::npos)
      << refusal(reversed);
  Sweep resistance = exact_sweep(published_langevin(), 27e3, 31.5e3, 200);
  for (auto& each : resistance.admittance_S) {
    each = 1.0 / 50.0;
  }
  disturb(resistance, 0.01, 0.01, 1);
  EXPECT_NE(refusal(resistance).find("those of a resistance"), std::string::npos)
      << refusal(resistance);
}

TEST(Selection, LeavesOutAReadingThatStandsAlone) {
  Sweep sweep = exact_sweep(published_piece(), 110e3, 117e3, 201);
  add_noise(sweep, 1e-3);
  sweep.admittance_S[60] *= 3.0;
  const Selection selected = select_circuit(sweep);
  EXPECT_EQ(selected.left_out_Hz, std::vector<double>{110e3 + 60 * 35.0});
  expect_near(selected.fit.circuit, published_piece(), 5e-3);
}

TEST(Study, WarnsOfAPhaseThatNoPassivePartHas) {
  Sweep sweep = exact_sweep(published_piece(), 110e3, 117e3, 201);
  add_noise(sweep, 1e-3);
  for (auto& each : sweep.admittance_S) {
    each *= std::polar(1.0, 0.1);
  }
  const ImpedanceStudy result = study("x", sweep, {});
  bool warned = false;
  for (const std::string& each : result.identification.warnings) {
    warned = warned || each.find("beyond 90 degrees") != std::string::npos;
  }
  EXPECT_TRUE(warned);
}

bool warns(const ImpedanceStudy& result, const std::string& of) {
  const std::vector<std::string>& all = result.identification.warnings;
  return std::any_of(all.begin(), all.end(),
                     [&](const std::string& each) { return each.find(of) != std::string::npos; });
}

TEST(Study, WarnsOfAResonanceThatMayBeInKilohertz) {
  const Sweep sweep = exact_sweep(published_piece(), 110e3, 117e3, 201);
  const std::string warning = "far below ultrasound";
  EXPECT_FALSE(warns(study("x", sweep, {}), warning));
  Sweep in_kHz = sweep;
  for (double& frequency_Hz : in_kHz.frequency_Hz) {
    frequency_Hz *= 1e-3;
  }
  EXPECT_TRUE(warns(study("x", in_kHz, {}), warning));
}

/// A ripple along the sweep that no circuit has.
TEST(Study, WarnsOfMisfitAndAllowsForIt) {
  Sweep sweep = exact_sweep(published_langevin(), 27e3, 31.5e3, 200);
  disturb(sweep, 1e-3, 1e-3, 1);
  for (std::size_t i = 0; i < sweep.frequency_Hz.size(); ++i) {
    sweep.admittance_S[i] *= std::exp(0.05 * std::sin(0.1 * static_cast<double>(i)));
  }
  const ImpedanceStudy result = study("x", sweep, {});
  EXPECT_TRUE(warns(result, "The circuit does not describe the sweep: what it leaves is"));
  EXPECT_GT(result.identification.misfit, 0.02);
  EXPECT_TRUE(holds(figure(result.fit, "motional_resistance_ohm"), 175.0));
  EXPECT_TRUE(holds(figure(result.fit, "motional_inductance_H"), 71e-3));
  EXPECT_TRUE(holds(figure(result.fit, "clamped_capacitance_F"), 3.2e-9));
}

/// Without a lead, phases that are 2 degrees off look like one of 38 ohm and a motional resistance of
/// 12 ohm.
TEST(Study, TakesNoErrorOfThePhaseForALead) {
  const Circuit truth{1.2e-9, 0.0, {mode_of(50.0, 40e-3, 0.1759e-9)}};
  Sweep sweep = exact_sweep(truth, 58e3, 66e3, 401);
  disturb(sweep, 1e-3, 1e-3, 1);
  for (auto& each : sweep.admittance_S) {
    each *= std::polar(1.0, -2.0 * two_pi / 360.0);
  }
  const ImpedanceStudy result = study("x", sweep, {});
  EXPECT_TRUE(warns(result, "The phases are off by -2"));
  EXPECT_TRUE(holds(figure(result.fit, "motional_resistance_ohm"), 50.0));
}

bool leaves_open(const ImpedanceStudy& result, const std::string& what) {
  const std::vector<std::string>& all = result.identification.cannot_tell;
  return std::any_of(all.begin(), all.end(),
                     [&](const std::string& each) { return each.find(what) != std::string::npos; });
}

TEST(Study, SaysThatAnInductanceInSeriesMayGoUnseen) {
  Sweep sweep = exact_sweep(published_langevin(), 27e3, 31.5e3, 200);
  disturb(sweep, 3e-3, 3e-3, 1);
  EXPECT_TRUE(leaves_open(study("x", sweep, {}), "makes the resonance come out -"));
  for (auto& each : sweep.admittance_S) {
    each = std::abs(each);
  }
  sweep.has_phase = false;
  EXPECT_TRUE(
      leaves_open(study("x", sweep, {}), "series inductance: magnitudes alone do not show it"));
}

TEST(Study, SaysThatALeadAndAnErrorOfThePhaseLookAlike) {
  Circuit truth = published_langevin();
  truth.lead = {5.0, 0.0};
  Sweep sweep = exact_sweep(truth, 27e3, 31.5e3, 200);
  disturb(sweep, 1e-3, 1e-3, 1);
  EXPECT_TRUE(
      leaves_open(study("x", sweep, {}),
                  "Whether leads, an error of the phase or a delay between the channels rotate"));
}

/// Nine, which are eight and misfit.
TEST(Study, WarnsOfMoreModesThanItFits) {
  Circuit truth{2e-9, 0.004, {}};
  for (int i = 0; i < most_modes + 1; ++i) {
    const double f = 40e3 + 2.3e3 * i;
    truth.modes.push_back({two_pi * f * 2e-11 * 200.0, f, f / 200.0});
  }
  Sweep sweep = exact_sweep(truth, 35e3, 62e3, 400);
  disturb(sweep, 5e-3, 5e-3, 1);
  const ImpedanceStudy result = study("x", sweep, {});
  EXPECT_EQ(result.fit.parts.modes, most_modes);
  EXPECT_TRUE(warns(result, "The circuit does not describe the sweep"));
  EXPECT_TRUE(warns(result, "Narrow the sweep to one resonance"));
}

/// Of 17 digits, as another program computes them.
TEST(Study, OfComputedReadingsHasOneModeAndFiniteIntervals) {
  const ImpedanceStudy result =
      study("x", exact_sweep(published_langevin(), 27e3, 31.5e3, 301), {});
  EXPECT_EQ(result.fit.parts.modes, 1);
  EXPECT_FALSE(has_lead(result.fit));
  EXPECT_TRUE(warns(result, "as computed ones do"));
  EXPECT_FALSE(leaves_open(result, "its interval goes from"));
  for (const Estimate& each : result.identification.parameters) {
    EXPECT_LT(each.low_95, each.value) << each.name;
    EXPECT_GT(each.high_95, each.value) << each.name;
    EXPECT_LT(each.high_95 - each.low_95, 1e-5 * std::max(each.value, 1e-3)) << each.name;
  }
}

/// A motional capacitance of 10000 times the clamped one.
TEST(Study, ARefusalOfSeveralModesAdvisesToNarrowTheSweep) {
  CircuitFit fit;
  fit.parts = {0b00001, 2};
  fit.circuit = {1e-13, 0.0, {mode_of(100.0, 30e-3, 1e-9), mode_of(300.0, 30e-3, 0.6e-9)}};
  try {
    require_inside(exact_sweep(fit.circuit, 25e3, 45e3, 100), fit);
    FAIL();
  } catch (const loop::ComputationError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("has modes at 29057.6, 37513.2 Hz: narrow the sweep to the resonance"),
              std::string::npos)
        << error.what();
  }
}

TEST(Study, NamesTheReadingsThatAreLeftOut) {
  Sweep sweep = exact_sweep(published_piece(), 110e3, 117e3, 201);
  add_noise(sweep, 1e-3);
  sweep.admittance_S[60] *= 3.0;
  EXPECT_TRUE(warns(study("x", sweep, {}), "off the readings beside it: 112.1 kHz."));
}

/// 20000 readings of which the mode with the largest G/f is not the one that is identified.
TEST(Study, UsesAllReadingsAboutTheResonanceOfALongSweep) {
  Circuit truth = published_langevin();
  truth.modes.push_back({1.0 / 250.0, 9e3, 50.0});
  Sweep sweep = exact_sweep(truth, 5e3, 45e3, 20000);
  disturb(sweep, 5e-3, 5e-3, 1);
  const ImpedanceStudy result = study("x", sweep, {});
  EXPECT_TRUE(warns(result, "all about 28.3"));
  EXPECT_LE(result.sweep.frequency_Hz.size(), most_readings);
  EXPECT_TRUE(holds(figure(result.fit, "motional_resistance_ohm"), 175.0));
}

TEST(Study, ARefusalSaysWhatWasAssumedOfTheFile) {
  Sweep capacitor = exact_sweep({2e-9, 0.01, {}}, 10e3, 20e3, 101);
  add_noise(capacitor, 1e-3);
  capacitor.warnings = {"The phase is taken for degrees."};
  try {
    study("x", capacitor, {});
    FAIL();
  } catch (const loop::ComputationError& error) {
    EXPECT_NE(std::string(error.what()).find("The phase is taken for degrees"), std::string::npos);
  }
}

/// Behind a question no full stop.
TEST(Study, ARefusalThatAsksGoesOnWithASentence) {
  Sweep reversed = exact_sweep(published_langevin(), 27e3, 31.5e3, 200);
  disturb(reversed, 1e-3, 1e-3, 1);
  for (auto& each : reversed.admittance_S) {
    each = std::conj(each);
  }
  reversed.warnings = {"The phase is taken for degrees."};
  try {
    study("x", reversed, {});
    FAIL();
  } catch (const loop::ComputationError& error) {
    EXPECT_NE(std::string(error.what()).find("shorted? The phase is taken for degrees"),
              std::string::npos)
        << error.what();
  }
}

TEST(Study, RefusesMassesThatNoSceneHas) {
  Sweep sweep = exact_sweep(published_langevin(), 27e3, 31.5e3, 200);
  add_noise(sweep, 1e-3);
  EXPECT_THROW(study("x", sweep, {std::nullopt, 1e-8}), loop::ComputationError);
}

TEST(Study, TheSceneTellsOfANegativeLossTangent) {
  Circuit truth = published_langevin();
  truth.loss_tangent = -0.003;
  Sweep sweep = exact_sweep(truth, 27e3, 31.5e3, 200);
  add_noise(sweep, 1e-3);
  const std::string scene = scene_toml(study("x", sweep, {0.1, std::nullopt}));
  EXPECT_NE(scene.find("loss_tangent = 0                    # fitted: -0.00"), std::string::npos)
      << scene;
}

TEST(Study, SaysWhatElectricalDataNeverTell) {
  Sweep sweep = exact_sweep(published_piece(), 110e3, 117e3, 201);
  add_noise(sweep, 1e-3);
  const ImpedanceStudy open = study("x", sweep, {});
  ASSERT_FALSE(open.identification.cannot_tell.empty());
  EXPECT_NE(open.identification.cannot_tell.front().find("--mass-kg"), std::string::npos);
  const ImpedanceStudy known = study("x", sweep, {0.01, std::nullopt});
  for (const Estimate& each : known.identification.parameters) {
    if (each.name == "stiffness_N_per_m") {
      EXPECT_NEAR(each.value, 0.01 * std::pow(two_pi * 112720.0, 2), 1e-3 * each.value);
    }
  }
}

}  // namespace
}  // namespace sonoglide::identify::impedance
