// Random loops at resonance: each that can be designed holds its vibration, and what keeps a friction
// ratio from its target has a name.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/report/step_metrics.hpp"
#include "host_sim/scene_file/scene_error.hpp"
#include "measured_run.hpp"
#include "tests/common/constants/pi.hpp"

namespace sonoglide::resonance_test {
namespace {

using tests::two_pi;

struct RandomLoop {
  double natural_Hz;
  double time_constant_s;
  std::string text;
};

class Draw {
 public:
  double between(double low, double high) {
    return low + (high - low) * std::uniform_real_distribution<double>()(random_);
  }
  double decades(double low, double high) {
    return std::exp(between(std::log(low), std::log(high)));
  }
  template <class T, std::size_t Count>
  T one_of(const T (&all)[Count]) {
    return all[random_() % Count];
  }

 private:
  std::mt19937_64 random_{2013};
};

RandomLoop draw_loop(Draw& draw) {
  const double natural_Hz = draw.decades(15e3, 150e3);
  const double rate_rad_per_s = two_pi * natural_Hz;
  const double quality = draw.decades(20.0, 3000.0);
  const double mass_kg = draw.decades(1e-4, 1.0);
  const double damping = mass_kg * rate_rad_per_s / quality;
  const double speed = draw.decades(3e-3, 0.3);
  const double sliding = speed * draw.one_of({1.0, -1.0});
  const double coefficient = draw.between(0.05, 0.5);
  const double normal_N = mass_kg * 9.81 * draw.decades(1.0, 30.0);
  const double friction_N = coefficient * normal_N;
  const double presliding_m = speed / rate_rad_per_s / draw.decades(0.05, 15.0);
  const double fastest = 3.0 * speed;
  const double most_V = draw.decades(1.4, 16.0) * (damping * fastest + 1.2 * friction_N);
  const double beside = draw.one_of({0.0, draw.between(-0.03, 0.03)});
  const double time_constant_s = 2.0 * quality / rate_rad_per_s;
  const double step_s = std::max(12.0 * time_constant_s, 150.0 / natural_Hz);
  std::string text = fmt::format(
      "[plant]\nmass_kg = {}\nstiffness_N_per_m = {:.17g}\ndamping_N_s_per_m = {}\n"
      "[friction]\nlaw = \"dahl\"\ncoefficient = {}\nnormal_force_N = {}\n"
      "contact_stiffness_N_per_m = {}\n"
      "[sliding]\nvelocity_m_per_s = {}\n"
      "[transducer]\nforce_factor_N_per_V = 1.0\nclamped_capacitance_F = 1e-12\n"
      "[drive]\nfrequency_Hz = {:.17g}\nmax_voltage_amplitude_V = {}\n"
      "[run]\nduration_s = {}\n[controller]\nvibration = \"resonant\"\n",
      mass_kg, mass_kg * rate_rad_per_s * rate_rad_per_s, damping, coefficient, normal_N,
      friction_N / presliding_m, sliding, natural_Hz * (1.0 + beside), most_V, 3.0 * step_s);
  text += fmt::format("arithmetic = \"{}\"\n", draw.one_of({"float32", "q31", "float64"}));
  text += fmt::format("target_friction_ratio = [[0.0, {}], ", draw.between(0.35, 0.9));
  text += fmt::format("[{}, {}], ", step_s, draw.between(0.35, 0.9));
  text += fmt::format("[{}, {}]]\n", 2.0 * step_s, draw.between(0.35, 0.9));
  text += fmt::format("[sensor]\nvibration = \"velocity\"\nforce = {}\n",
                      draw.one_of({"true", "false"}));
  text += fmt::format("vibration_noise_m_per_s = {}\n", draw.one_of({0.0, 1e-3 * fastest}));
  text += draw.one_of({"", "vibration_bits = 12\n", "vibration_bits = 14\n"});
  text += fmt::format("[model_error]\nstiffness = {}\n",
                      draw.one_of({1.0, (1.0 + beside) * (1.0 + beside), 1.01}));
  text += fmt::format("mass = {}\n", draw.one_of({1.0, 0.85, 1.2}));
  text += fmt::format("damping = {}\n", draw.one_of({1.0, 0.5, 0.7, 2.0}));
  return {natural_Hz, time_constant_s, text};
}

TEST(RandomResonance, HoldsItsVibrationAndNamesWhatIsOffTarget) {
  constexpr int loops = 100;
  Draw draw;
  int refused = 0;
  for (int i = 0; i < loops; ++i) {
    const RandomLoop given = draw_loop(draw);
    scene::Scene scene;
    try {
      scene = experiment::read_text(given.text, "random.toml").plant;
    } catch (const scene_file::SceneError& error) {
      EXPECT_NE(std::string(error.what()).find("drive.max_voltage_amplitude_V: adds"),
                std::string::npos)
          << error.what();
      ++refused;
      continue;
    }
    const acceptance::MeasuredRun ran = acceptance::run_measured(scene);
    for (const report::StepMetrics& step : ran.steps) {
      ASSERT_TRUE(step.vibration->settling_time_s) << given.text;
      EXPECT_LE(*step.vibration->settling_time_s,
                6.0 * given.time_constant_s + 30.0 / given.natural_Hz)
          << given.text;
      EXPECT_TRUE(step.settling_time_s || step.limit != control::Limit::none) << given.text;
    }
    EXPECT_TRUE(ran.run.result.control->faults.empty()) << given.text;
  }
  EXPECT_LE(refused, loops / 10);
}

/// Three targets of a resonator that is well inside its drive, the force sensor ideal.
struct HeldLoop {
  double natural_Hz;
  double time_constant_s;
  double full_m_per_s;    ///< at full drive
  double target_m_per_s;  ///< about what a target needs
  std::string text;       ///< a [sensor] table without its vibration, and a [model_error], follow
};

HeldLoop draw_held_loop(Draw& draw) {
  const double natural_Hz = draw.decades(20e3, 100e3);
  const double rate_rad_per_s = two_pi * natural_Hz;
  const double quality = draw.decades(50.0, 1000.0);
  const double mass_kg = draw.decades(1e-3, 0.1);
  const double damping = mass_kg * rate_rad_per_s / quality;
  const double speed = draw.decades(5e-3, 0.1);
  const double friction_N = 0.1 * mass_kg * 9.81 * draw.decades(1.0, 10.0);
  const double target = 2.0 * speed;
  const double most_V = draw.decades(2.0, 8.0) * (1.5 * damping * target + 1.2 * friction_N);
  const double step_s = std::max(20.0 * quality / rate_rad_per_s, 150.0 / natural_Hz);
  std::string text = fmt::format(
      "[plant]\nmass_kg = {}\nstiffness_N_per_m = {:.17g}\ndamping_N_s_per_m = {}\n"
      "[friction]\nlaw = \"dahl\"\ncoefficient = 0.1\nnormal_force_N = {}\n"
      "contact_stiffness_N_per_m = {}\n"
      "[sliding]\nvelocity_m_per_s = {}\n"
      "[transducer]\nforce_factor_N_per_V = 1.0\nclamped_capacitance_F = 1e-12\n"
      "[drive]\nfrequency_Hz = {:.17g}\nmax_voltage_amplitude_V = {}\n"
      "[run]\nduration_s = {}\n[controller]\nvibration = \"resonant\"\narithmetic = \"{}\"\n"
      "target_friction_ratio = [[0.0, {}], [{}, {}], [{}, {}]]\n",
      mass_kg, mass_kg * rate_rad_per_s * rate_rad_per_s, damping, 10.0 * friction_N,
      draw.decades(0.1, 10.0) * friction_N * rate_rad_per_s / speed, speed, natural_Hz, most_V,
      3.0 * step_s, draw.one_of({"float32", "q31", "float64"}), draw.between(0.35, 0.85), step_s,
      draw.between(0.35, 0.85), 2.0 * step_s, draw.between(0.35, 0.85));
  return {natural_Hz, 2.0 * quality / rate_rad_per_s, most_V / damping, target, text};
}

acceptance::MeasuredRun run_text(const std::string& text) {
  return acceptance::run_measured(experiment::read_text(text, "random.toml").plant);
}

/// Of sorted values, about the one that this part of them does not exceed.
double quantile(std::vector<double> values, double part) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
}

// With a motional current whose force factor is off by up to a quarter. The first target learns it.
TEST(RandomResonance, LearnsAForceFactorOnce) {
  constexpr int loops = 60;
  Draw draw;
  std::vector<double> periods;
  double beyond = 0.0;
  for (int i = 0; i < loops; ++i) {
    const HeldLoop given = draw_held_loop(draw);
    const double error = draw.one_of({draw.between(0.75, 0.9), draw.between(1.1, 1.25)});
    const std::vector<report::StepMetrics> steps =
        run_text(given.text + fmt::format("[sensor]\nvibration = \"motional_current\"\n"
                                          "[model_error]\nforce_factor = {}\n",
                                          error))
            .steps;
    for (std::size_t k = 1; k < steps.size(); ++k) {
      const double from = steps[k - 1].vibration->velocity_m_per_s;
      const double to = steps[k].vibration->velocity_m_per_s;
      const double full = given.full_m_per_s;
      const double bound_s =
          given.time_constant_s * (to > from ? std::log((full - from) / (full - to))
                                             : std::log((full + from) / (full + to)));
      ASSERT_TRUE(steps[k].settling_time_s) << given.text << error;
      periods.push_back((*steps[k].settling_time_s - bound_s) * given.natural_Hz);
      beyond = std::max(beyond, steps[k].overshoot);
    }
  }
  EXPECT_LE(quantile(periods, 0.5), 4.0);
  EXPECT_LE(quantile(periods, 0.9), 8.0);
  EXPECT_LE(beyond, 0.04);
}

// The band is twice that of other tests: noise alone moves the ratio of a stiff contact.
TEST(RandomResonance, SettlesInNoise) {
  constexpr int loops = 80;
  Draw draw;
  for (int i = 0; i < loops; ++i) {
    const HeldLoop given = draw_held_loop(draw);
    std::string text = given.text;
    text.replace(text.find("[run]\n"), 6, "[run]\nsettling_band = 0.02\n");
    const std::vector<report::StepMetrics> steps =
        run_text(text + fmt::format("[sensor]\nvibration = \"velocity\"\nvibration_bits = 12\n"
                                    "vibration_noise_m_per_s = {}\n",
                                    0.003 * given.target_m_per_s))
            .steps;
    for (const report::StepMetrics& step : steps) {
      EXPECT_TRUE(step.settling_time_s) << text << step.ripple;
      EXPECT_LE(step.ripple, 0.012) << text;
    }
  }
}

}  // namespace
}  // namespace sonoglide::resonance_test
