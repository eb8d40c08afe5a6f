#include "host_sim/configure/vibration/sensorless_reading.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/turn.hpp"
#include "host_sim/configure/design_steps.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/scene/friction_laws.hpp"

namespace sonoglide::configure {
namespace {

ReadingChain chain_of(const scene::Sensor& sensor, double period_s) {
  ReadingChain chain;
  if (const std::optional<double> low_pass_Hz = sensor.low_pass_Hz()) {
    const double periods = numeric::two_pi * *low_pass_Hz * period_s;
    chain.fade = numeric::exp(-periods);
    chain.fresh = 1.0 + numeric::expm1(-periods) / periods;
    chain.old = 1.0 - chain.fade - chain.fresh;
  }
  return chain;
}

/// Rms of a measured ratio.
double reading_noise(const scene::Sensor& sensor, double friction_N) {
  const double rounding_N = code_N(sensor);
  const double noise_N = sensor.reading_noise_N();
  return numeric::sqrt(noise_N * noise_N + rounding_N * rounding_N / 12.0) / friction_N;
}

}  // namespace

bool slides_backwards(const scene::Sliding& sliding) {
  return std::any_of(sliding.profile.begin(), sliding.profile.end(),
                     [](const auto& point) { return point.velocity_m_per_s < 0.0; });
}

FrictionReading friction_reading(const scene::Scene& scene, const NominalPlant& plant,
                                 double velocity_m_per_s) {
  const double period_s = 1.0 / scene.drive->frequency_Hz;
  const double speed_m_per_s = scene.sliding.fastest_m_per_s();
  FrictionReading reading;
  reading.speed = speed_m_per_s / velocity_m_per_s;
  const bool elastic = scene::is_elastic(scene.friction.law);
  reading.lambda = elastic ? plant.contact_stiffness_N_per_m * speed_m_per_s * period_s /
                                 (numeric::two_pi * plant.friction_N)
                           : std::numeric_limits<double>::infinity();
  const bool backwards = slides_backwards(scene.sliding);
  reading.sign = (backwards ? -1.0 : 1.0) * vibration_sign(scene.friction.sign_convention);
  reading.chain = chain_of(scene.sensor, period_s);
  constexpr double usual_ratio = 0.6;
  constexpr double short_memory = 0.1;
  constexpr double longest_memory = 0.9;  // more would make too much of noise
  const double memory = friction_response(reading.contact(usual_ratio, 0.0)).memory;
  reading.chain.contact_memory = memory > short_memory ? std::min(memory, longest_memory) : 0.0;
  reading.noise = reading_noise(scene.sensor, plant.friction_N);
  reading.model_lift = 1.0;
  constexpr double lifted = 0.2;
  for (const double kept : {reading.chain.fade, reading.chain.contact_memory}) {
    reading.noise *= numeric::sqrt(1.0 + kept * kept) / (1.0 - kept);
    reading.model_lift *= 1.0 + lifted * kept / (1.0 - kept);
  }
  return reading;
}

double noise_of(double ratio, const FrictionReading& reading) {
  constexpr double rest = 0.001;  // of the velocity: map and contact, in a settled loop
  // Of Coulomb friction: a velocity per ratio, per sliding velocity.
  const double steepness =
      0.25 * numeric::two_pi * numeric::sqrt(1.0 - ratio * ratio) / (ratio * ratio);
  const double model = rest * reading.model_lift / ratio;
  const double sensor = reading.noise * steepness;
  return numeric::sqrt(model * model + sensor * sensor);
}

}  // namespace sonoglide::configure
