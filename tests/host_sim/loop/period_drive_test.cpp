/// How the drive passes from one amplitude to the next: what is left of the vibration against closed
/// forms, the powers against their identity and against quadrature.

#include "host_sim/loop/plant/period_drive.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "host_sim/loop/electrical.hpp"
#include "host_sim/loop/plant/carrier_grid.hpp"
#include "host_sim/loop/plant_run.hpp"
#include "host_sim/scene/solver_methods.hpp"
#include "tests/common/constants/pi.hpp"

namespace sonoglide::loop::period_drive_test {
namespace {

using scene::Interpolation;
using scene::Scene;
using tests::two_pi;
using Complex = std::complex<double>;
using namespace std::complex_literals;

constexpr double frequency_Hz = 60e3;
constexpr double mass_kg = 0.02;

/// A mass on a spring, without friction.
Scene scene_of(double natural_over_carrier, Interpolation interpolation, int codes) {
  const double natural_rad_per_s = two_pi * frequency_Hz * natural_over_carrier;
  Scene scene;
  scene.plant.mass_kg = mass_kg;
  scene.plant.stiffness_N_per_m = mass_kg * natural_rad_per_s * natural_rad_per_s;
  scene.sliding.profile = {{0.0, 0.1}};
  scene.drive.emplace();
  scene.drive->frequency_Hz = frequency_Hz;
  scene.drive->interpolation = interpolation;
  scene.drive->codes_per_period = codes;
  scene.solver.tolerance = 1e-13;
  scene.run.duration_s = 3.0 / frequency_Hz;
  return scene;
}

/// A plant under these amplitudes, one each carrier period.
struct Driven {
  RunResult result;
  std::vector<PlantState> states;
  std::vector<EnergyBalance> energies;
};
Driven driven(const Scene& scene, const std::vector<double>& amplitudes_N) {
  Driven all;
  Watch watch;
  watch.energies = true;
  CarrierClock clock(scene);
  PlantRun plant(scene, clock, watch, all.result);
  for (const double amplitude_N : amplitudes_N) {
    all.energies.push_back(plant.advance(amplitude_N));
    all.states.push_back(plant.state());
    clock.next();
  }
  return all;
}

/// Amplitude of the free vibration over that of the forced one, one period after the amplitude
/// began to pass from 0 to 1.
double ringing(const Scene& scene) {
  constexpr double amplitude_N = 1000.0;
  const double omega = two_pi * frequency_Hz;
  const double natural = std::sqrt(scene.plant.stiffness_N_per_m / mass_kg);
  const double forced_m = amplitude_N / (scene.plant.stiffness_N_per_m - mass_kg * omega * omega);
  const PlantState state = driven(scene, {amplitude_N}).states.back();
  return std::hypot(state.displacement_m - forced_m, state.velocity_m_per_s / natural) /
         std::abs(forced_m);
}

/// Free vibration of a jump at a phase, a: natural over carrier frequency.
Complex kick(double phase, double a) {
  return 0.5 * (1.0 + 1.0 / a) * std::exp(1i * (1.0 - a) * phase) +
         0.5 * (1.0 - 1.0 / a) * std::exp(-1i * (1.0 + a) * phase);
}
/// Its mean over a period.
Complex mean_kick(double a) {
  const auto mean = [](double turns) {
    return turns == 0.0 ? Complex(1.0)
                        : (std::exp(1i * turns * two_pi) - 1.0) / (1i * turns * two_pi);
  };
  return 0.5 * (1.0 + 1.0 / a) * mean(1.0 - a) + 0.5 * (1.0 - 1.0 / a) * mean(-(1.0 + a));
}
/// Of n + 1 jumps, half as high at the ends.
Complex mean_of_kicks(double a, int n) {
  Complex sum = 0.0;
  for (int i = 0; i <= n; ++i) {
    const double height = (i == 0 || i == n ? 0.5 : 1.0) / n;
    sum += height * kick(two_pi * i / n, a);
  }
  return sum;
}

const std::vector<double> modes = {0.47, 0.9,  1.5,  1.9, 2.01, 2.064,
                                   2.5,  2.98, 3.02, 3.5, 3.85, 4.003};

TEST(PeriodDriveTest, LeavesTheVibrationOfTheClosedForm) {
  for (const double a : modes) {
    SCOPED_TRACE(a);
    EXPECT_NEAR(ringing(scene_of(a, Interpolation::step, 1)), 1.0, 1e-9);
    EXPECT_NEAR(ringing(scene_of(a, Interpolation::linear, 1)), std::abs(mean_kick(a)), 1e-9);
    for (const int codes : {2, 4, 8}) {
      EXPECT_NEAR(ringing(scene_of(a, Interpolation::linear, codes)),
                  std::abs(mean_of_kicks(a, codes)), 1e-9)
          << codes;
    }
  }
}

/// As a table prints it: natural over carrier frequency, what a line leaves, and 8, 4 and 2 codes.
TEST(PeriodDriveTest, LeavesAThousandthWhereAJumpLeavesAll) {
  EXPECT_NEAR(ringing(scene_of(4.003, Interpolation::linear, 1)), 0.001, 5e-4);
  EXPECT_NEAR(ringing(scene_of(2.01, Interpolation::linear, 1)), 0.008, 5e-4);
  EXPECT_NEAR(ringing(scene_of(2.5, Interpolation::linear, 1)), 0.176, 5e-4);
  EXPECT_NEAR(ringing(scene_of(2.5, Interpolation::linear, 8)), 0.138, 5e-4);
  EXPECT_NEAR(ringing(scene_of(2.5, Interpolation::linear, 4)), 0.109, 5e-4);
  EXPECT_NEAR(ringing(scene_of(2.5, Interpolation::linear, 2)), 0.500, 5e-4);
}

/// In every method that solves a mass without friction.
TEST(PeriodDriveTest, LeavesTheSameWithEverySolver) {
  for (const auto& each : scene::solver_methods) {
    SCOPED_TRACE(each.name);
    Scene scene = scene_of(2.064, Interpolation::linear, 1);
    scene.solver.method = each.value;
    scene.solver.tolerance = 1e-9;
    scene.solver.step_s = 1.0 / (frequency_Hz * 4000.0);
    EXPECT_NEAR(ringing(scene), std::abs(mean_kick(2.064)), 1e-8);
  }
}

/// A mode of 200 carriers: the closed form takes the period in which the amplitude holds.
TEST(PeriodDriveTest, PassesUnderAStiffMode) {
  const double a = 200.25;
  Scene scene = scene_of(a, Interpolation::linear, 1);
  EXPECT_NEAR(ringing(scene), std::abs(mean_kick(a)), 1e-9);
  const auto steps = [&scene](int held) {
    Watch watch;
    CarrierClock clock(scene);
    RunResult result;
    PlantRun plant(scene, clock, watch, result);
    for (int period = 0; period <= held; ++period) {
      plant.advance(1000.0);
      clock.next();
    }
    plant.finish();
    return result.solver_steps;
  };
  EXPECT_EQ(steps(2), steps(0) + 2);
}

// ---- With a transducer ----

Scene transduced(Interpolation interpolation, int codes) {
  Scene scene = scene_of(2.064, interpolation, codes);
  scene.plant.damping_N_s_per_m = 40.0;
  scene.transducer = {16.0, 2e-8, 0.02};
  return scene;
}

const std::vector<double> amplitudes_N = {800.0, 300.0, 300.0, 1200.0};

TEST(PeriodDriveTest, ElectricalPowersBalance) {
  for (const int codes : {1, 2, 4, 8}) {
    Scene scene = transduced(Interpolation::linear, codes);
    scene.run.duration_s = 3.7 / frequency_Hz;  // the last is cut short
    scene.run.window_start_s = 0.3 / frequency_Hz;
    const ElectricalFigures figures =
        electrical_figures(*driven(scene, amplitudes_N).result.electrical);
    EXPECT_LT(figures.balance_residual, 1e-11) << codes;
    EXPECT_EQ(figures.voltage_peak_V, 1200.0 / 16.0);
  }
}

/// The voltage of a phase, a ramp or a staircase, and its rise with time between jumps.
struct Voltage {
  double before_V, after_V;
  int codes;

  double peak(double phase) const {
    const double part = phase / two_pi;
    const double passed = codes == 1 ? part : (std::floor(part * codes) + 0.5) / codes;
    return before_V + (after_V - before_V) * passed;
  }
  double at(double phase) const { return peak(phase) * std::cos(phase); }
  double rise(double phase) const {
    const double slope = codes == 1 ? (after_V - before_V) / two_pi : 0.0;
    return two_pi * frequency_Hz * (slope * std::cos(phase) - peak(phase) * std::sin(phase));
  }
};

/// A held mass has the current of its capacitance alone.
TEST(PeriodDriveTest, TheClampedCurrentIsThatOfTheVoltage) {
  for (const int codes : {1, 2, 4, 8}) {
    SCOPED_TRACE(codes);
    Scene scene = transduced(Interpolation::linear, codes);
    const scene::Transducer& transducer = *scene.transducer;
    const Voltage voltage{20.0, 50.0, codes};
    const PeriodDrive drive(scene, 20.0 * 16.0, 50.0 * 16.0, 0.0);
    constexpr int points = 8 << 14;
    Complex voltage_V = 0.0;
    Complex current = 0.0;
    double square = 0.0;
    double losses = 0.0;
    for (int i = 0; i < points; ++i) {
      const double phase = two_pi * (i + 0.5) / points;
      const double own_A = transducer.clamped_capacitance_F *
                           (voltage.rise(phase) +
                            two_pi * frequency_Hz * transducer.loss_tangent * voltage.at(phase));
      voltage_V += 2.0 / points * voltage.at(phase) * std::polar(1.0, -phase);
      current += 2.0 / points * own_A * std::polar(1.0, -phase);
      square += own_A * own_A / (points * frequency_Hz);
      losses += transducer.clamped_capacitance_F * two_pi * frequency_Hz * transducer.loss_tangent *
                voltage.at(phase) * voltage.at(phase) / (points * frequency_Hz);
    }
    EXPECT_LT(std::abs(drive.fundamental_N() / 16.0 - voltage_V), 1e-6);
    EXPECT_LT(std::abs(current_A(transducer, drive, frequency_Hz, 0.0) - current),
              1e-8 * std::abs(current));
    if (codes == 1) {
      Stretch stretch;
      stretch.duration_s = 1.0 / frequency_Hz;
      stretch.drive_rate_rad_per_s = two_pi * frequency_Hz;
      stretch.drive_amplitude_N = 20.0 * 16.0;
      stretch.drive_slope_N_per_rad = 30.0 * 16.0 / two_pi;
      const ElectricalBalance own = electrical_balance(transducer, stretch, EnergyBalance());
      EXPECT_NEAR(own.current_square_A2_s, square, 1e-8 * square);
      EXPECT_NEAR(own.losses_J, losses, 1e-8 * losses);
    }
  }
}

}  // namespace
}  // namespace sonoglide::loop::period_drive_test
