#include "host_sim/studies/identify/impedance/circuit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "synthetic.hpp"

namespace sonoglide::identify::impedance {
namespace {

using Complex = std::complex<double>;

/// jωC0(1 − j tan δ) + 1/(R + jωL + 1/(jωC)), written out.
TEST(Circuit, IsTheAdmittanceOfItsElements) {
  Circuit circuit = published_piece();
  circuit.loss_tangent = 0.01;
  const Complex j(0.0, 1.0);
  for (const double f : {1e3, 112e3, 112.72e3, 114e3, 5e6}) {
    const double w = two_pi * f;
    const Complex expected =
        j * w * 1.53668657e-9 * (1.0 - 0.01 * j) +
        1.0 / (106.327685 + j * w * 52.6754086e-3 + 1.0 / (j * w * 37.8469081e-12));
    EXPECT_NEAR(std::abs(circuit.admittance_S(f) - expected), 0.0, 1e-9 * std::abs(expected)) << f;
  }
}

TEST(Circuit, HasItsLeadInSeries) {
  Circuit circuit = published_langevin();
  const double f = 28.4e3;
  const Complex behind_ohm = 1.0 / circuit.admittance_S(f);
  circuit.lead = {5.0, 1e-6};
  const Complex expected = behind_ohm + Complex(5.0, two_pi * f * 1e-6);
  EXPECT_NEAR(std::abs(1.0 / circuit.admittance_S(f) - expected), 0.0, 1e-9 * std::abs(expected));
}

TEST(Circuit, HasThePublishedFiguresOfAPiece) {
  const Circuit circuit = published_piece();
  EXPECT_NEAR(circuit.modes.front().quality(), 350.866897, 1e-5);
  EXPECT_NEAR(circuit.modes.front().inductance_H(), 52.6754086e-3, 1e-14);
  EXPECT_NEAR(circuit.modes.front().capacitance_F(), 37.8469081e-12, 1e-23);
}

/// A Langevin transducer of 38.62 and 39.77 kHz has k_eff = √(1 − (fs/fp)²) = 0.239, as published.
TEST(Circuit, HasThePublishedCouplingOfALangevinTransducer) {
  const double ratio = std::pow(39.77 / 38.62, 2) - 1.0;  // C1/C0
  const double quality = 500.0;
  const Circuit circuit{
      3e-9, 0.0, {{two_pi * 38620.0 * ratio * 3e-9 * quality, 38620.0, 38620.0 / quality}}};
  EXPECT_NEAR(circuit.antiresonance_Hz(), 39770.0, 1e-6);
  EXPECT_NEAR(circuit.coupling(), 0.239, 5e-4);
}

TEST(Circuit, DerivativesAreThoseOfDifferences) {
  Circuit circuit = published_piece();
  circuit.loss_tangent = 0.01;
  circuit.modes.push_back({1e-4, 113.5e3, 500.0});
  circuit.lead = {5.0, 2e-6};
  circuit.rotation_rad = 0.02;
  circuit.delay_s = 50e-9;
  circuit.lean = 0.3;
  circuit.modes.push_back({3e-4, 115e3, 400.0});
  const Eigen::VectorXd p = to_vector(circuit);
  Eigen::VectorXcd derivatives;
  const double f = 112.8e3;
  circuit.admittance_S(f, &derivatives);
  ASSERT_EQ(derivatives.size(), p.size());
  for (Eigen::Index i = 0; i < p.size(); ++i) {
    // Of inductance and delay in parts of themselves.
    const bool is_small = i == index_of(Part::lead_inductance) || i == index_of(Part::delay);
    const double step = 1e-6 * (is_small ? p(i) : 1.0);
    Eigen::VectorXd more = p;
    Eigen::VectorXd less = p;
    more(i) += step;
    less(i) -= step;
    const Complex difference =
        (to_circuit(more).admittance_S(f) - to_circuit(less).admittance_S(f)) / (2.0 * step);
    EXPECT_NEAR(std::abs(derivatives(i) - difference), 0.0, 1e-5 * std::abs(difference)) << i;
  }
}

/// f0 = fs − s Δ |i/i_max|², iterated.
TEST(Circuit, LeansWithTheSquareOfItsCurrent) {
  Circuit circuit = published_langevin();
  circuit.clamped_capacitance_F = 1e-30;
  circuit.loss_tangent = 0.0;
  const Mode mode = circuit.modes.front();
  for (const double lean : {0.3, -0.5}) {
    circuit.lean = lean;
    for (const double f : {27.5e3, 28.2e3, 28.3e3, 28.4e3, 29e3}) {
      double power = 0.5;
      for (int i = 0; i < 2000; ++i) {
        const double d = (f * f - mode.resonance_Hz * mode.resonance_Hz) / (f * mode.bandwidth_Hz) +
                         2.0 * lean * power;
        power += 0.2 * (1.0 / (1.0 + d * d) - power);
      }
      EXPECT_NEAR(std::norm(circuit.admittance_S(f)) / (mode.conductance_S * mode.conductance_S),
                  power, 1e-9)
          << f;
    }
  }
}

}  // namespace
}  // namespace sonoglide::identify::impedance
