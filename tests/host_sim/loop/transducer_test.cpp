/// The transducer: its admittance against the equivalent circuit, the vibration that it drives
/// against closed forms, its powers against their identity.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <complex>
#include <cstddef>
#include <memory>
#include <vector>

#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/loop/electrical.hpp"
#include "host_sim/loop/plant/plant_port.hpp"
#include "tests/common/constants/pi.hpp"
#include "tests/host_sim/loop/logs/logged_run.hpp"

namespace sonoglide::loop::transducer_test {
namespace {

using scene::Scene;
using tests::two_pi;
using Complex = std::complex<double>;
using namespace std::complex_literals;

/// Butterworth-Van Dyke: C0 beside Rm, Lm and Cm in series.
struct Circuit {
  double clamped_F;
  double loss_tangent;
  double motional_ohm;
  double motional_H;
  double motional_F;

  double series_resonance_Hz() const { return 1.0 / (two_pi * std::sqrt(motional_H * motional_F)); }
  double quality() const { return std::sqrt(motional_H / motional_F) / motional_ohm; }
  Complex clamped_S(double frequency_Hz) const {
    const double susceptance_S = two_pi * frequency_Hz * clamped_F;
    return {susceptance_S * loss_tangent, susceptance_S};
  }
  Complex admittance_S(double frequency_Hz) const {
    const double omega = two_pi * frequency_Hz;
    const double reactance_ohm = omega * motional_H - 1.0 / (omega * motional_F);
    return clamped_S(frequency_Hz) + 1.0 / Complex(motional_ohm, reactance_ohm);
  }
};

/// A published fit of a piece at 112.7 kHz, and a wire bonder's transducer as it may be.
const std::vector<Circuit> circuits = {
    {1.53668657e-9, 0.0, 106.327685, 52.6754086e-3, 37.8469081e-12},
    {3.0e-9, 0.004, 40.0, 0.0212, 332e-12},
};
constexpr double force_factor_N_per_V = 0.7;
constexpr double voltage_V = 12.0;

/// The same as a mass on a spring, without friction.
Scene scene_of(const Circuit& circuit, double frequency_Hz) {
  const double square = force_factor_N_per_V * force_factor_N_per_V;
  Scene scene;
  scene.plant.mass_kg = circuit.motional_H * square;
  scene.plant.stiffness_N_per_m = square / circuit.motional_F;
  scene.plant.damping_N_s_per_m = circuit.motional_ohm * square;
  scene.sliding.profile = {{0.0, 0.1}};
  scene.transducer = {force_factor_N_per_V, circuit.clamped_F, circuit.loss_tangent};
  scene.drive.emplace();
  scene.drive->frequency_Hz = frequency_Hz;
  scene.drive->voltage_amplitude_V = voltage_V;
  scene.solver.tolerance = 1e-12;
  scene.run.duration_s = 10.0 / frequency_Hz;
  return scene;
}

/// From the powers of the steady orbit: S = V conj(I)/2.
Complex admittance_S(const Circuit& circuit, double frequency_Hz) {
  Scene scene = scene_of(circuit, frequency_Hz);
  scene.run.start = scene::Start::steady;
  const ElectricalFigures figures = electrical_figures(*run(scene).electrical);
  return 2.0 / (voltage_V * voltage_V) *
         Complex(figures.active_power_W, -figures.reactive_power_var);
}

TEST(TransducerTest, HasTheAdmittanceOfItsCircuit) {
  for (const Circuit& circuit : circuits) {
    const double series_Hz = circuit.series_resonance_Hz();
    const double parallel_Hz = series_Hz * std::sqrt(1.0 + circuit.motional_F / circuit.clamped_F);
    for (const double frequency_Hz : {0.5 * series_Hz, 0.99 * series_Hz, series_Hz,
                                      1.001 * series_Hz, parallel_Hz, 1.7 * series_Hz}) {
      const Complex expected = circuit.admittance_S(frequency_Hz);
      EXPECT_LE(std::abs(admittance_S(circuit, frequency_Hz) - expected), 1e-9 * std::abs(expected))
          << frequency_Hz;
    }
  }
}

// fs is where the motional conductance is largest, 1/Rm; the motional admittance is on a circle
// through 0 whose diameter is 1/Rm.
TEST(TransducerTest, ConductsMostAtItsSeriesResonance) {
  for (const Circuit& circuit : circuits) {
    const double series_Hz = circuit.series_resonance_Hz();
    const auto motional_S = [&](double frequency_Hz) {
      return admittance_S(circuit, frequency_Hz) - circuit.clamped_S(frequency_Hz);
    };
    const double diameter_S = 1.0 / circuit.motional_ohm;
    EXPECT_NEAR(motional_S(series_Hz).real(), diameter_S, 1e-9 * diameter_S);
    for (const double detuning : {-1.0, -0.1, 0.1, 1.0}) {
      const Complex beside = motional_S(series_Hz * (1.0 + detuning / circuit.quality()));
      EXPECT_LT(beside.real(), 0.99 * diameter_S) << detuning;
      EXPECT_NEAR(std::abs(beside - 0.5 * diameter_S), 0.5 * diameter_S, 1e-9 * diameter_S);
    }
  }
}

/// Fundamental over each carrier period of the vibration from rest under a force that begins at
/// phase 0, in closed form: a steady part, and a free one B e^{λt}.
class RingUp {
 public:
  explicit RingUp(const Scene& scene) : rate_(two_pi * scene.drive->frequency_Hz) {
    const scene::Plant& plant = scene.plant;
    const double decay = 0.5 * plant.damping_N_s_per_m / plant.mass_kg;
    const double square = plant.stiffness_N_per_m / plant.mass_kg - decay * decay;
    lambda_ = {-decay, std::sqrt(square)};
    const Complex displacement_m =
        scene.drive_force_N() / Complex(plant.stiffness_N_per_m - plant.mass_kg * rate_ * rate_,
                                        plant.damping_N_s_per_m * rate_);
    steady_ = 1i * rate_ * displacement_m;
    // x(0) = Re(X + A) = 0 and x'(0) = Re(jωX + λA) = 0; the free velocity is Re(λA e^{λt}).
    const double real = -displacement_m.real();
    const double imaginary = (steady_.real() + lambda_.real() * real) / lambda_.imag();
    free_ = lambda_ * Complex(real, imaginary);
  }

  Complex over_period(std::size_t index) const {
    const double period_s = two_pi / rate_;
    const double begin_s = static_cast<double>(index) * period_s;
    return steady_ + (average(free_, lambda_, begin_s, period_s) +
                      average(std::conj(free_), std::conj(lambda_), begin_s, period_s));
  }
  Complex steady() const { return steady_; }

 private:
  /// (1/T)∫ B e^{(λ - jω)t} dt; the carrier begins each period at phase 0.
  Complex average(Complex amplitude, Complex lambda, double begin_s, double period_s) const {
    const Complex turn = lambda - 1i * rate_;
    return amplitude * std::exp(lambda * begin_s) * (std::exp(turn * period_s) - 1.0) /
           (turn * period_s);
  }

  double rate_;
  Complex lambda_;
  Complex steady_;
  Complex free_;
};

TEST(TransducerTest, RingsUpAsTheClosedFormDoes) {
  for (const Circuit& circuit : circuits) {
    for (const double detuning : {0.0, 1e-3, -0.02}) {
      Scene scene = scene_of(circuit, circuit.series_resonance_Hz() * (1.0 + detuning));
      scene.run.duration_s = 400.0 / scene.drive->frequency_Hz;
      const RingUp expected(scene);
      const LoggedRun logged = run_logged(scene);
      ASSERT_EQ(logged.periods.size(), 400U);
      for (std::size_t k = 0; k < logged.periods.size(); ++k) {
        ASSERT_LE(std::abs(logged.periods[k].vibration_m_per_s - expected.over_period(k)),
                  1e-9 * std::abs(expected.steady()))
            << k;
      }
    }
  }
}

// x' = Re(z e^jθ) with z' = (-σ + j(ωn - ω)) z + Fe/2m, to the order of 1/Q.
TEST(TransducerTest, FollowsTheEnvelopeNearResonance) {
  const Circuit circuit = circuits.front();
  const double quality = circuit.quality();
  const double tau_s = 2.0 * quality / (two_pi * circuit.series_resonance_Hz());
  Scene scene = scene_of(circuit, circuit.series_resonance_Hz() * (1.0 + 0.5 / quality));
  scene.run.duration_s = 1.2 * tau_s;
  const LoggedRun logged = run_logged(scene);
  const auto after_tau = static_cast<std::size_t>(tau_s * scene.drive->frequency_Hz);
  const double at_resonance_m_per_s = scene.drive_force_N() / scene.plant.damping_N_s_per_m;
  const Complex expected = {0.55539688, -0.24583701};
  EXPECT_LE(std::abs(logged.periods[after_tau].vibration_m_per_s / at_resonance_m_per_s - expected),
            2.0 / quality);
}

/// From the steady vibration at resonance, the drive turned by half a turn at R times the amplitude:
/// carrier periods until the vibration is at its smallest.
TEST(TransducerTest, BrakesAsTheEnvelopeDoes) {
  const Circuit circuit = circuits.front();
  const double frequency_Hz = circuit.series_resonance_Hz();
  constexpr double head_room = 5.0;
  Scene scene = scene_of(circuit, frequency_Hz);
  const std::unique_ptr<PlantPort> plant = make_plant_port(scene);
  const double steady_m_per_s = scene.drive_force_N() / scene.plant.damping_N_s_per_m;
  plant->begin_at({0.0, steady_m_per_s, 0.0}, {});
  Stretch period;
  period.duration_s = 1.0 / frequency_Hz;
  period.drive_rate_rad_per_s = two_pi * frequency_Hz;
  period.drive_amplitude_N = -head_room * scene.drive_force_N();
  period.demodulated = true;
  double smallest_m_per_s = steady_m_per_s;
  double braked_s = 0.0;
  for (int k = 0; k < 60; ++k) {
    EnergyBalance energy;
    ASSERT_EQ(plant->advance(period, energy).error, plant::Error::none);
    const double vibration_m_per_s = std::abs(energy.vibration_m_per_s());
    if (vibration_m_per_s < smallest_m_per_s) {
      smallest_m_per_s = vibration_m_per_s;
      braked_s = (k + 0.5) * period.duration_s;
    }
  }
  const double tau_s = 2.0 * circuit.quality() / period.drive_rate_rad_per_s;
  EXPECT_NEAR(braked_s, tau_s * std::log((head_room + 1.0) / head_room), period.duration_s);
  EXPECT_LT(smallest_m_per_s, 0.03 * steady_m_per_s);
}

// In-phase fundamental of Coulomb friction: (4/π)√(1 - r²) Fc, and nothing in quadrature.
TEST(TransducerTest, FrictionAtResonanceMeetsItsDescribingFunction) {
  const Circuit circuit = circuits.front();
  for (const double velocity_ratio : {0.1, 0.5, 0.9}) {
    Scene scene = scene_of(circuit, circuit.series_resonance_Hz());
    const double free_m_per_s = scene.drive_force_N() / scene.plant.damping_N_s_per_m;
    scene.sliding.profile = {{0.0, velocity_ratio * free_m_per_s}};
    scene.friction.law = scene::laws::Coulomb{};
    scene.friction.coefficient = 0.1;
    scene.friction.normal_force_N = 1e-4 * scene.drive_force_N();
    scene.run.start = scene::Start::steady;
    const LoggedRun logged = run_logged(scene);
    const double lost_N = scene.plant.damping_N_s_per_m *
                          (free_m_per_s - logged.periods.back().vibration_m_per_s.real());
    const double expected =
        2.0 * two_pi / (tests::pi * tests::pi) * std::sqrt(1.0 - velocity_ratio * velocity_ratio);
    EXPECT_NEAR(lost_N / scene.friction.limit_N(), expected, 1e-3) << velocity_ratio;
  }
}

using Exact = long double;
using ExactState = std::array<Exact, 4>;  ///< x, x', F, ∫F dt

/// A Dahl contact on a damped spring, in long double and in SI units.
struct ExactPlant {
  Exact mass_kg;
  Exact stiffness_N_per_m;
  Exact damping_N_s_per_m;
  Exact limit_N;
  Exact contact_stiffness_N_per_m;
  Exact sliding_m_per_s;

  Exact slip_m_per_s(const ExactState& at) const { return sliding_m_per_s + at[1]; }
  /// @param direction  sign of the slip, ±1: held over a step, so that the rate is smooth in it
  ExactState rate(const ExactState& at, Exact drive_N, Exact direction) const {
    const Exact force_N = drive_N - damping_N_s_per_m * at[1] - stiffness_N_per_m * at[0] - at[2];
    const Exact dahl = contact_stiffness_N_per_m * (1 - direction * at[2] / limit_N);
    return {at[1], force_N / mass_kg, dahl * slip_m_per_s(at), at[2]};
  }
};

ExactPlant exact(const Scene& scene) {
  return {static_cast<Exact>(scene.plant.mass_kg),
          static_cast<Exact>(scene.plant.stiffness_N_per_m),
          static_cast<Exact>(scene.plant.damping_N_s_per_m),
          static_cast<Exact>(scene.friction.limit_N()),
          static_cast<Exact>(scene.friction.contact_stiffness_N_per_m),
          static_cast<Exact>(scene.sliding.profile.front().velocity_m_per_s)};
}

/// Advances it by duration_s under drive_N(time_s). A step ends where the slip turns: across a
/// reversal the rate has a kink, which costs a Runge-Kutta method its order.
template <class Drive>
void advance(const ExactPlant& plant, const Drive& drive_N, Exact duration_s, ExactState& state) {
  namespace odeint = boost::numeric::odeint;
  using Formula = odeint::runge_kutta_fehlberg78<ExactState, Exact>;
  Formula formula;
  auto controlled = odeint::make_controlled(Exact(1e-24), Exact(1e-17), Formula());
  Exact direction = plant.slip_m_per_s(state) < 0 ? -1 : 1;
  const auto system = [&](const ExactState& at, ExactState& rate, Exact time_s) {
    rate = plant.rate(at, drive_N(time_s), direction);
  };
  const auto goes_on = [&] { return direction * plant.slip_m_per_s(state) >= 0; };
  Exact time_s = 0;
  for (Exact step_s = 1e-7L; time_s < duration_s;) {
    step_s = std::min(step_s, duration_s - time_s);
    const ExactState before = state;
    const Exact begin_s = time_s;
    if (controlled.try_step(system, state, time_s, step_s) == odeint::fail || goes_on()) {
      continue;
    }
    Exact least_s = 0;
    Exact most_s = time_s - begin_s;
    for (int halvings = 0; halvings < 70; ++halvings) {
      const Exact middle_s = (least_s + most_s) / 2;
      state = before;
      formula.do_step(system, state, begin_s, middle_s);
      (goes_on() ? least_s : most_s) = middle_s;
    }
    state = before;
    formula.do_step(system, state, begin_s, most_s);
    time_s = begin_s + most_s;
    direction = -direction;
  }
}

/// Its motion under a carrier whose frequency is taken at the beginning of each period.
ExactState chirped(const Scene& scene) {
  const ExactPlant plant = exact(scene);
  const auto amplitude_N = static_cast<Exact>(scene.drive_force_N());
  const auto duration_s = static_cast<Exact>(scene.run.duration_s);
  ExactState state{};
  for (Exact begin_s = 0; begin_s < duration_s;) {
    const auto frequency_Hz = static_cast<Exact>(
        configure::carrier_frequency_Hz(*scene.drive, static_cast<double>(begin_s)));
    const Exact end_s = std::min(begin_s + 1 / frequency_Hz, duration_s);
    const auto drive_N = [&](Exact time_s) {
      return amplitude_N * std::cos(2 * tests::long_pi * frequency_Hz * time_s);
    };
    advance(plant, drive_N, end_s - begin_s, state);
    begin_s = end_s;
  }
  return state;
}

/// Across the resonance of a contact that bends the motion, in a hundred carrier periods.
Scene chirp_scene() {
  const Circuit circuit = circuits.back();
  Scene scene = scene_of(circuit, circuit.series_resonance_Hz());
  scene.plant.damping_N_s_per_m *= 0.5;
  scene.friction.law = scene::laws::Dahl{};
  scene.friction.coefficient = 0.1;
  scene.friction.normal_force_N = 10.0;
  scene.friction.contact_stiffness_N_per_m = 2e6;
  scene.run.duration_s = 100.0 / scene.drive->frequency_Hz;
  scene.drive->frequency_profile = {{0.0, 0.97 * scene.drive->frequency_Hz},
                                    {scene.run.duration_s, 1.03 * scene.drive->frequency_Hz}};
  return scene;
}

TEST(TransducerTest, AFrequencyThatChangesEveryPeriodIsFollowedToTheTolerance) {
  const Scene scene = chirp_scene();
  const ExactState expected = chirped(scene);
  const RunResult result = run(scene);
  const double velocity_m_per_s = scene.drive_force_N() / scene.plant.damping_N_s_per_m;
  EXPECT_NEAR(result.final_state.displacement_m, static_cast<double>(expected[0]),
              1e-11 * velocity_m_per_s / (two_pi * scene.drive->frequency_Hz));
  EXPECT_NEAR(result.final_state.velocity_m_per_s, static_cast<double>(expected[1]),
              1e-11 * velocity_m_per_s);
  const double limit_N_s = scene.friction.limit_N() * scene.run.duration_s;
  EXPECT_NEAR(result.whole.friction_impulse_N_s / limit_N_s,
              static_cast<double>(expected[3]) / limit_N_s, 1e-11);
}

// Over a part of a carrier period a product with the carrier is no fundamental.
TEST(TransducerTest, APeriodThatIsCutShortHasNoFundamental) {
  const Circuit circuit = circuits.front();
  Scene scene = scene_of(circuit, circuit.series_resonance_Hz());
  scene.run.start = scene::Start::steady;
  const double peak_A = electrical_figures(*run(scene).electrical).current_peak_A;
  scene.run.duration_s = 10.1 / scene.drive->frequency_Hz;
  const LoggedRun longer = run_logged(scene);
  EXPECT_NEAR(electrical_figures(*longer.result.electrical).current_peak_A, peak_A, 1e-9 * peak_A);
  EXPECT_TRUE(std::isnan(longer.periods.back().vibration_m_per_s.real()));
  scene.run.duration_s = 0.5 / scene.drive->frequency_Hz;
  const ElectricalFigures shorter = electrical_figures(*run(scene).electrical);
  EXPECT_TRUE(std::isnan(shorter.current_peak_A));
  EXPECT_NEAR(shorter.voltage_peak_V, voltage_V, 1e-12);
}

TEST(TransducerTest, AWindowInsideAPeriodSeesItsPeaks) {
  const Circuit circuit = circuits.front();
  Scene scene = scene_of(circuit, circuit.series_resonance_Hz());
  scene.run.window_start_s = 9.5 / scene.drive->frequency_Hz;
  const ElectricalFigures figures = electrical_figures(*run(scene).electrical);
  EXPECT_NEAR(figures.voltage_peak_V, voltage_V, 1e-12);
  EXPECT_GT(figures.current_peak_A, 0.0);
}

TEST(TransducerTest, ElectricalEnergyIsAccountedFor) {
  const Circuit circuit = circuits.back();
  for (const double normal_force_N : {0.0, 1.0, 100.0}) {
    Scene scene = scene_of(circuit, circuit.series_resonance_Hz());
    scene.friction.law = scene::laws::Dahl{};
    scene.friction.coefficient = 0.1;
    scene.friction.normal_force_N = normal_force_N;
    scene.friction.contact_stiffness_N_per_m = 1e6;
    scene.drive->frequency_profile = {{0.0, 58e3}, {1e-3, 62e3}};
    scene.run.duration_s = 1.0003e-3;
    scene.run.window_start_s = 0.2004e-3;
    const RunResult result = run(scene);
    const ElectricalFigures figures = electrical_figures(*result.electrical);
    EXPECT_LE(figures.balance_residual, 1e-9) << normal_force_N;
    EXPECT_LE(power_ratios(scene, result.window).balance_residual, 1e-9);
    EXPECT_GT(figures.apparent_power_VA, figures.active_power_W);
    EXPECT_NEAR(figures.voltage_peak_V, voltage_V, 1e-12);
  }
}

}  // namespace
}  // namespace sonoglide::loop::transducer_test
