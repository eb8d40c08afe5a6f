#include "host_sim/studies/identify/impedance/selection.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "host_sim/loop/failure.hpp"
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
  EXPECT_NE(refusal(capacitor).find("no resonance is seen"), std::string::npos);
  const Circuit above{2e-9, 0.0, {{1e-2, 30e3, 100.0}}};
  Sweep flank = exact_sweep(above, 10e3, 28e3, 101);
  add_noise(flank, 1e-4);
  EXPECT_NE(refusal(flank).find("not in the sweep"), std::string::npos) << refusal(flank);
}

TEST(Selection, LeavesOutAReadingThatStandsAlone) {
  Sweep sweep = exact_sweep(published_piece(), 110e3, 117e3, 201);
  add_noise(sweep, 1e-3);
  sweep.admittance_S[60] *= 3.0;
  const Selection selected = select_circuit(sweep);
  EXPECT_EQ(selected.left_out, std::vector<std::size_t>{60});
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
