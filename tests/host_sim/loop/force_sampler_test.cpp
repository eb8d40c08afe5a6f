/// What a converter sees of a friction force that jumps: against closed forms of the low-pass, and in
/// whole loops against the exact mean.

#include "host_sim/loop/force_sampler.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/scene/scene.hpp"
#include "tests/common/constants/pi.hpp"
#include "tests/host_sim/loop/logs/logged_run.hpp"

namespace sonoglide::loop::force_sampler_test {
namespace {

constexpr double carrier_Hz = 60e3;
constexpr double period_s = 1.0 / carrier_Hz;

scene::Scene sampled(int samples, std::optional<double> filter_Hz) {
  scene::Scene scene;
  scene.drive.emplace();
  scene.drive->frequency_Hz = carrier_Hz;
  scene.sensor.samples_per_period = samples;
  scene.sensor.filter_Hz = filter_Hz;
  return scene;
}

/// A force of 1 N from jump_s on, in a carrier period of zero before it and one after it.
std::vector<double> samples_of_a_jump(const scene::Scene& scene, double jump_s) {
  ForceSampler sampler(scene);
  std::vector<double> all;
  for (int period = 0; period < 2; ++period) {
    sampler.begin_period();
    for (int i = 1; i <= sampler.intervals(); ++i) {
      const double end_s = period_s * i / sampler.intervals();
      EnergyBalance so_far;
      so_far.duration_s = end_s;
      so_far.friction_impulse_N_s = period == 1 ? end_s : std::max(0.0, end_s - jump_s);
      sampler.take(so_far, period == 1 || end_s > jump_s ? 1.0 : 0.0);
    }
    const std::vector<double>& seen = sampler.samples_N();
    EXPECT_EQ(seen.size(), static_cast<std::size_t>(*scene.sensor.samples_per_period));
    all.insert(all.end(), seen.begin(), seen.end());
  }
  return all;
}

TEST(ForceSamplerTest, FollowsAJumpWithinItsBound) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (const int samples : {1, 3, 8, 64, 100}) {
    for (const double filter_Hz : {6e3, 60e3, 600e3, 6e6}) {
      const double tau_s = 1.0 / (tests::two_pi * filter_Hz);
      for (int trial = 0; trial < 20; ++trial) {
        const double jump_s = part(random) * period_s;
        const std::vector<double> seen = samples_of_a_jump(sampled(samples, filter_Hz), jump_s);
        for (std::size_t i = 0; i < seen.size(); ++i) {
          const double since_s = period_s * static_cast<double>(i + 1) / samples - jump_s;
          const double expected = since_s > 0.0 ? -std::expm1(-since_s / tau_s) : 0.0;
          EXPECT_NEAR(seen[i], expected, 0.0013) << samples << ' ' << filter_Hz << ' ' << i;
        }
      }
    }
  }
}

/// It settles between two stops of the plant, however fast it is.
TEST(ForceSamplerTest, BehindAFilterOfNoTimeTakesWhatThereIs) {
  for (const double filter_Hz : {1e8, 1e12}) {
    for (const double frequency_Hz : {1.0, 60e3}) {
      scene::Scene scene = sampled(4, filter_Hz);
      scene.drive->frequency_Hz = frequency_Hz;
      const ForceSampler sampler(scene);
      EXPECT_EQ(sampler.intervals(), 8192) << filter_Hz << ' ' << frequency_Hz;
    }
  }
  const std::vector<double> seen = samples_of_a_jump(sampled(4, 1e12), 0.3 * period_s);
  EXPECT_EQ(seen, (std::vector<double>{0.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0}));
}

TEST(ForceSamplerTest, WithoutAFilterASampleIsTheForceOfItsMoment) {
  for (const int samples : {1, 4, 16}) {
    const std::vector<double> seen = samples_of_a_jump(sampled(samples, {}), 0.3 * period_s);
    for (std::size_t i = 0; i < seen.size(); ++i) {
      EXPECT_EQ(seen[i], static_cast<double>(i + 1) > 0.3 * samples ? 1.0 : 0.0);
    }
  }
}

TEST(ForceSamplerTest, ASceneThatNamesNoSamplesHasOneInterval) {
  scene::Scene scene;
  scene.drive.emplace();
  ForceSampler sampler(scene);
  EXPECT_EQ(sampler.intervals(), 1);
  sampler.take({}, 1.0);
  EXPECT_TRUE(sampler.samples_N().empty());
}

/// Mean of the true friction ratio over the last quarter of a loop with Coulomb friction.
double settled_ratio(double target, const std::string& drive, const std::string& sensor) {
  const std::string text =
      "[plant]\nmass_kg = 0.02\nstiffness_N_per_m = 133e6\n"
      "[friction]\nlaw = \"coulomb\"\ncoefficient = 0.1\nnormal_force_N = 0.1962\n"
      "[sliding]\nvelocity_m_per_s = 0.0267\n"
      "[drive]\nfrequency_Hz = 60e3\nmax_force_amplitude_N = 1920\n" +
      drive +
      "[solver]\ntolerance = 1e-8\n[run]\nduration_s = 4e-3\n"
      "[controller]\narithmetic = \"float64\"\ntarget_friction_ratio = [[0, " +
      std::to_string(target) + "]]\n[sensor]\n" + sensor;
  const std::vector<Period> periods = run_logged(experiment::read_text(text, "s").plant).periods;
  double sum = 0.0;
  const std::size_t first = periods.size() * 3 / 4;
  for (std::size_t i = first; i < periods.size(); ++i) {
    sum += periods[i].friction_ratio / static_cast<double>(periods.size() - first);
  }
  return sum;
}

double worst_miss(const std::string& sensor) {
  double worst = 0.0;
  for (int i = 1; i <= 9; ++i) {
    const double target = 0.1 * i;
    worst = std::max(worst, std::abs(settled_ratio(target, "", sensor) - target));
  }
  return worst;
}

/// A square wave of friction that few samples cannot tell, and what a filter and more of them give.
TEST(SampledLoopTest, FewSamplesMissWhatAFilterOrMoreOfThemTell) {
  const double eight = worst_miss("samples_per_period = 8\n");
  const double filtered = worst_miss("samples_per_period = 8\nfilter_Hz = 60e3\n");
  const double many = worst_miss("samples_per_period = 64\nfilter_Hz = 60e3\n");
  RecordProperty("eight", std::to_string(eight));
  RecordProperty("filtered", std::to_string(filtered));
  RecordProperty("many", std::to_string(many));
  EXPECT_GT(eight, 0.1);
  EXPECT_LT(filtered, 0.02);
  EXPECT_LT(many, 0.0005);
}

}  // namespace
}  // namespace sonoglide::loop::force_sampler_test
