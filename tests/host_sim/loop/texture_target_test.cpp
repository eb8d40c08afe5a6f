/// A target along the sliding distance: the harmonics of what the plant renders, against a plant of this
/// test's own and against its own sums.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/scene/names.hpp"
#include "tests/common/constants/table_1_numbers.hpp"
#include "tests/common/table_1.hpp"

namespace sonoglide::loop::texture_target_test {
namespace {

using scene::Arithmetic;
using scene::Scene;
using Complex = std::complex<double>;
using tests::pi;

struct Rendered {
  RunResult result;
  std::vector<Period> periods;
};
Rendered run_of(const Scene& scene) {
  PeriodRecording recording;
  Watch watch;
  watch.periods.push_back(&recording);
  Rendered run{loop::run(scene, watch), {}};
  run.periods = std::move(recording.periods);
  return run;
}

/// mean + amplitude sin(2π x / period), at points that are equally spaced.
scene::Texture sine(double period_m, double mean, double amplitude, bool of_force = false) {
  constexpr int points = 32;
  scene::Texture texture{period_m, {}, of_force};
  for (int i = 0; i < points; ++i) {
    texture.values.push_back(mean + amplitude * std::sin(2.0 * pi * i / points));
  }
  return texture;
}

/// Table 1 with ratio 0.5 ± 0.2 at a frequency of the texture.
Scene textured(double frequency_Hz, Arithmetic arithmetic = Arithmetic::float64) {
  Scene scene = tests::table_1_closed_loop(arithmetic);
  scene.controller->target_friction_ratio.clear();
  scene.controller->texture = sine(scene.sliding.fastest_m_per_s() / frequency_Hz, 0.5, 0.2);
  scene.run.duration_s = 8.0 / frequency_Hz;
  return scene;
}

/// Of a value over the whole periods of the path between two turns, by the midpoint of each carrier
/// period; c in Re(c e^(j 2π h x/P)), the mean for h = 0.
template <class ValueOf>
Complex harmonic(const std::vector<Period>& periods, double period_m, int number, double from_turn,
                 double to_turn, const ValueOf& value_of) {
  Complex sum = 0.0;
  for (const Period& period : periods) {
    // The sliding is constant: the distance needs no integral.
    const double speed = period.begin_velocity_m_per_s;
    const double begin = period.begin_s * speed / period_m;
    const double end = period.end_s * speed / period_m;
    const double inside = std::min(end, to_turn) - std::max(begin, from_turn);
    if (inside > 0.0) {
      const double middle = 0.5 * (std::min(end, to_turn) + std::max(begin, from_turn));
      sum += value_of(period) * inside * std::polar(1.0, -2.0 * pi * number * middle);
    }
  }
  return (number == 0 ? 1.0 : 2.0) / (to_turn - from_turn) * sum;
}

double lag_deg(Complex wanted, Complex rendered) {
  return std::arg(wanted / rendered) * 180.0 / pi;
}

/// sin(x) = Re(-j e^(jx)); the straight lines between 32 points leave sinc² of it.
Complex wanted_sine(double amplitude) {
  const double x = pi / 32.0;
  return {0.0, -amplitude * std::pow(std::sin(x) / x, 2)};
}

class TextureTest : public testing::TestWithParam<Arithmetic> {};

/// What was asked for: at 1 kHz off resonance within 5 % and 20 degrees.
TEST_P(TextureTest, AKilohertzOffResonanceIsRendered) {
  const Scene scene = textured(1000.0, GetParam());
  const Rendered run = run_of(scene);
  EXPECT_TRUE(run.result.control->faults.empty());
  const auto ratio = [](const Period& period) { return period.friction_ratio; };
  const double period_m = scene.controller->texture->period_m;
  const Complex first = harmonic(run.periods, period_m, 1, 3.0, 7.0, ratio);
  const Complex mean = harmonic(run.periods, period_m, 0, 3.0, 7.0, ratio);
  EXPECT_NEAR(std::abs(first), 0.2, 0.05 * 0.2);
  EXPECT_NEAR(lag_deg(wanted_sine(0.2), first), 0.0, 20.0);
  EXPECT_NEAR(mean.real(), 0.5, 0.02);
}

/// A force is held the same; and the friction of the moment is not what it was.
TEST_P(TextureTest, AForceIsRenderedWhateverTheFriction) {
  for (const double believed : {1.0, 0.7, 1.4}) {
    Scene scene = textured(500.0, GetParam());
    const double friction_N = scene.friction.limit_N();
    scene.controller->texture =
        sine(scene.controller->texture->period_m, 0.5 * friction_N, 0.2 * friction_N, true);
    scene.model_error.coefficient = believed;
    scene.sensor.force_full_scale_N = 4.0 * friction_N;
    const Rendered run = run_of(scene);
    EXPECT_TRUE(run.result.control->faults.empty()) << believed;
    const auto force = [&](const Period& period) { return period.friction_force_N / friction_N; };
    const double period_m = scene.controller->texture->period_m;
    const double mean = harmonic(run.periods, period_m, 0, 3.0, 7.0, force).real();
    const Complex first = harmonic(run.periods, period_m, 1, 3.0, 7.0, force);
    EXPECT_NEAR(mean, 0.5, believed == 1.0 ? 0.01 : 0.05) << believed;
    EXPECT_NEAR(std::abs(first), 0.2, (believed == 1.0 ? 0.05 : 0.3) * 0.2) << believed;
    EXPECT_NEAR(lag_deg(wanted_sine(0.2), first), 0.0, 20.0) << believed;
  }
}

INSTANTIATE_TEST_SUITE_P(Arithmetics, TextureTest,
                         testing::Values(Arithmetic::float64, Arithmetic::float32, Arithmetic::q31,
                                         Arithmetic::q15),
                         [](const auto& instance) {
                           return std::string(scene::name_of(scene::arithmetics, instance.param));
                         });

/// Table 1 by itself: m x'' = −k x − F + A cos ωt, F' = Kt V (1 − F sgn V / Fc), V = Vt + x'.
class OwnPlant {
 public:
  explicit OwnPlant(const Scene& scene)
      : mass_(scene.plant.mass_kg),
        stiffness_(scene.plant.stiffness_N_per_m),
        contact_(scene.friction.contact_stiffness_N_per_m),
        limit_(scene.friction.limit_N()),
        sliding_(scene.sliding.fastest_m_per_s()) {}

  /// The mean force over a carrier period under a constant amplitude; Runge-Kutta of order 4.
  double mean_N(double amplitude_N) {
    constexpr int steps = 400;
    constexpr double h = tests::period_s / steps;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
      const double t = h * i;
      const State a = slope(state_, t, amplitude_N);
      const State b = slope(moved(state_, a, 0.5 * h), t + 0.5 * h, amplitude_N);
      const State c = slope(moved(state_, b, 0.5 * h), t + 0.5 * h, amplitude_N);
      const State d = slope(moved(state_, c, h), t + h, amplitude_N);
      const double before = state_[2];
      for (std::size_t k = 0; k < state_.size(); ++k) {
        state_[k] += h / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]);
      }
      sum += 0.5 * (before + state_[2]);
    }
    return sum / steps;
  }

 private:
  using State = std::array<double, 3>;  // displacement, velocity, friction

  static State moved(State state, const State& slope, double h) {
    for (std::size_t k = 0; k < state.size(); ++k) {
      state[k] += h * slope[k];
    }
    return state;
  }
  State slope(const State& s, double t, double amplitude_N) const {
    const double v = sliding_ + s[1];
    const double drive = amplitude_N * std::cos(2.0 * pi * tests::carrier_Hz * t);
    return {s[1], (drive - stiffness_ * s[0] - s[2]) / mass_,
            contact_ * (v - std::abs(v) * s[2] / limit_)};
  }

  double mass_;
  double stiffness_;
  double contact_;
  double limit_;
  double sliding_;
  State state_{};
};

/// The drive of the loop on a plant that we did not take from it renders the same texture.
TEST(Texture, IsRenderedByAPlantOfThisTestToo) {
  Scene scene = textured(1000.0);
  scene.friction.initial_force_N = 0.0;
  const Rendered run = run_of(scene);
  OwnPlant plant(scene);
  std::vector<Period> own = run.periods;
  for (Period& period : own) {
    period.friction_ratio = plant.mean_N(period.drive_amplitude_N) / scene.friction.limit_N();
  }
  const auto ratio = [](const Period& period) { return period.friction_ratio; };
  const double period_m = scene.controller->texture->period_m;
  for (const int number : {0, 1, 2}) {
    const Complex ours = harmonic(run.periods, period_m, number, 3.0, 7.0, ratio);
    const Complex theirs = harmonic(own, period_m, number, 3.0, 7.0, ratio);
    EXPECT_NEAR(std::abs(ours - theirs), 0.0, 1e-3) << number;
  }
}

/// Backwards the path is retraced; a sliding that turns keeps its place.
TEST(Texture, IsRetracedBackwards) {
  Scene scene = textured(500.0);
  const double speed = scene.sliding.fastest_m_per_s();
  scene.sliding.profile = {{0.0, speed}, {8e-3, speed}, {9e-3, -speed}};
  scene.run.duration_s = 20e-3;
  const Rendered run = run_of(scene);
  EXPECT_TRUE(run.result.control->faults.empty());
  // Of the way back, whole periods of the path well after the turn.
  double distance_m = 0.0;
  double sum = 0.0;
  double worst = 0.0;
  int count = 0;
  for (const Period& period : run.periods) {
    const double middle_m =
        distance_m + 0.25 * (3.0 * period.begin_velocity_m_per_s + period.end_velocity_m_per_s) *
                         (period.end_s - period.begin_s) * 0.5;
    distance_m += 0.5 * (period.begin_velocity_m_per_s + period.end_velocity_m_per_s) *
                  (period.end_s - period.begin_s);
    EXPECT_NEAR(period.end_distance_m, distance_m, 1e-12);
    if (period.begin_s > 11e-3 && period.whole) {
      const double error = period.friction_ratio - scene.controller->texture->at(middle_m);
      sum += error * error;
      worst = std::max(worst, std::abs(error));
      ++count;
    }
  }
  EXPECT_LT(std::sqrt(sum / count), 0.03);
  EXPECT_LT(worst, 0.1);
}

/// A sensor of few bits is what the distance rests on: 12 of them are enough for a place that holds.
TEST(Texture, HasNoDriftBesideItsSensor) {
  Scene scene = textured(500.0, Arithmetic::float32);
  scene.run.duration_s = 200e-3;
  scene.solver.tolerance = 1e-6;
  const Rendered run = run_of(scene);
  const auto ratio = [](const Period& period) { return period.friction_ratio; };
  const double period_m = scene.controller->texture->period_m;
  const Complex early = harmonic(run.periods, period_m, 1, 4.0, 8.0, ratio);
  const Complex late = harmonic(run.periods, period_m, 1, 94.0, 98.0, ratio);
  EXPECT_NEAR(lag_deg(early, late), 0.0, 0.1);
}

/// What the period of a path may be, by the steps of the controller and its base of velocity.
TEST(TextureDesign, APeriodOfFewStepsIsRefused) {
  Scene scene = textured(1000.0);
  for (const double period_m : {1e-6, 3e-6, 1e9}) {
    scene.controller->texture->period_m = period_m;
    try {
      configure::design_control(scene);
      FAIL() << period_m;
    } catch (const configure::ConfigurationError& error) {
      EXPECT_EQ(error.key(), "controller.target_texture");
    }
  }
}

/// At Q 200 and 33 kHz the amplitude changes by what the drive can: |dv/dt| <= (R v_max − v)/τ. The share
/// of the bound that the design tells is that of the steepest slope of the wanted velocity, by finite
/// differences of a fine grid.
TEST(TextureDesign, TellsTheBoundOfAResonator) {
  const experiment::Experiment plate =
      experiment::read_file(std::string(SONOGLIDE_SCENES) + "/haptic_plate.toml");
  Scene scene = plate.plant;
  scene.plant.damping_N_s_per_m = scene.plant.mass_kg * 2.0 * pi * 33e3 / 200.0;
  scene.controller->target_friction_ratio.clear();
  for (const double period_m : {0.125e-3, 1e-3, 10e-3}) {
    scene.controller->texture = sine(period_m, 0.5, 0.2);
    const configure::ControlDesign design = configure::design_control(scene);
    const double tau_s = 2.0 * scene.plant.mass_kg / scene.plant.damping_N_s_per_m;
    const double full_m_per_s = scene.max_drive_force_N() / scene.plant.damping_N_s_per_m;
    const configure::VibrationMap map = design.vibration_map(scene.friction.limit_N());
    const double speed = scene.sliding.fastest_m_per_s();
    double overload = 0.0;
    constexpr int points = 2000;
    const auto velocity = [&](int i) {
      return map.velocity_m_per_s(scene.controller->texture->at(period_m * i / points), speed);
    };
    for (int i = 0; i < points; ++i) {
      const double slope = (velocity(i + 1) - velocity(i)) / (period_m / points) * speed;
      const double v = velocity(i);
      const double bound = (full_m_per_s - (slope > 0.0 ? v : -v)) / tau_s;
      overload = std::max(overload, std::abs(slope) / bound);
    }
    EXPECT_NEAR(design.texture->overload, overload, 0.03 * overload) << period_m;
    EXPECT_EQ(design.texture->limit, control::Limit::voltage);
  }
}

}  // namespace
}  // namespace sonoglide::loop::texture_target_test
