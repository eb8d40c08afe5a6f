#include "host_sim/loop/force_sampler.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/turn.hpp"

namespace sonoglide::loop {
namespace {

constexpr double least_per_period = 64.0;
constexpr double least_per_time_constant = 10.0;
/// Behind a faster filter a sample is the mean over this part of a period, which is as good as a point.
constexpr double most_per_period = 8192.0;

/// Between two samples.
int intervals_of(const scene::Scene& scene) {
  const scene::Sensor& sensor = scene.sensor;
  if (!sensor.filter_Hz) {
    return 1;
  }
  const double time_constants =
      numeric::two_pi * *sensor.filter_Hz / scene.drive->frequency_Hz;  // in a period
  const double wanted =
      std::clamp(least_per_time_constant * time_constants, least_per_period, most_per_period);
  return static_cast<int>(std::ceil(wanted / *sensor.samples_per_period));
}

}  // namespace

ForceSampler::ForceSampler(const scene::Scene& scene) {
  if (!scene.sensor.samples_per_period) {
    return;
  }
  intervals_per_sample_ = intervals_of(scene);
  intervals_ = intervals_per_sample_ * *scene.sensor.samples_per_period;
  filter_rad_per_s_ = numeric::two_pi * scene.sensor.filter_Hz.value_or(0.0);
}

void ForceSampler::begin_period() {
  passed_ = 0;
  impulse_N_s_ = 0.0;
  passed_s_ = 0.0;
  samples_N_.clear();
}

void ForceSampler::take(const EnergyBalance& so_far, double force_N) {
  if (intervals_per_sample_ == 0) {
    return;
  }
  const double impulse_N_s =
      so_far.friction_impulse_N_s - std::exchange(impulse_N_s_, so_far.friction_impulse_N_s);
  const double duration_s = so_far.duration_s - std::exchange(passed_s_, so_far.duration_s);
  if (filter_rad_per_s_ > 0.0) {
    filtered_N_ -=
        numeric::expm1(-filter_rad_per_s_ * duration_s) * (impulse_N_s / duration_s - filtered_N_);
  } else {
    filtered_N_ = force_N;
  }
  if (++passed_ == intervals_per_sample_) {
    passed_ = 0;
    samples_N_.push_back(filtered_N_);
  }
}

}  // namespace sonoglide::loop
