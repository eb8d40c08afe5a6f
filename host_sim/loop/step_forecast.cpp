#include "host_sim/loop/step_forecast.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>

#include "firmware/numeric/turn.hpp"
#include "firmware/plant/outcome.hpp"
#include "host_sim/loop/plant/carrier_grid.hpp"
#include "host_sim/loop/plant/plant_port.hpp"
#include "host_sim/loop/plant/sliding_profile.hpp"
#include "host_sim/loop/plant/step_meter.hpp"

namespace sonoglide::loop {
namespace {

constexpr int half_periods = 4;
constexpr std::uint64_t most_steps = plant::max_steps_per_advance;

/// Half a period, number n: no waveform has a corner in it.
Stretch half_period(const scene::Scene& scene, int n, StepMeter& meter) {
  const double duration_s = 0.5 * CarrierGrid(scene).period_s();
  Stretch half;
  half.duration_s = duration_s;
  half.begin_s = n * duration_s;
  half.sliding_velocity_m_per_s = SlidingProfile::of(scene).velocity_m_per_s(half.begin_s);
  if (scene.load && !scene.load->force_profile_N.empty()) {
    half.load_force_N = scene::value_at(scene.load->force_profile_N, half.begin_s);
  }
  half.meter = &meter;
  if (scene.drive) {
    const scene::Drive& drive = *scene.drive;
    half.drive_rate_rad_per_s = drive.rate_rad_per_s();
    half.drive_phase_rad = n % 2 == 0 ? 0.0 : 0.5 * numeric::two_pi;
    half.drive_amplitude_N = std::max(scene.drive_force_N(), scene.max_drive_force_N());
    half.drive_waveform = drive.waveform;
  }
  return half;
}

}  // namespace

double expected_steps(const scene::Scene& scene) {
  const auto plant = make_plant_port(scene);
  StepMeter meter(most_steps);
  double counted_s = 0.0;
  std::uint64_t before = 0;
  double begin_s = 0.0;
  try {
    for (int n = 0; n < half_periods; ++n) {
      if (n == half_periods / 2) {
        before = meter.count();
        begin_s = counted_s;
      }
      const Stretch half = half_period(scene, n, meter);
      EnergyBalance energy;
      const plant::Outcome<double> outcome = plant->advance(half, energy);
      if (outcome.error == plant::Error::too_many_steps) {
        throw StepsRanOut(half.begin_s + outcome.offset);
      }
      if (outcome.error != plant::Error::none) {
        return 0.0;
      }
      counted_s += half.duration_s;
    }
  } catch (const StepsRanOut& out) {
    before = 0;
    begin_s = 0.0;
    counted_s = out.time_s;
  }
  return static_cast<double>(meter.count() - before) / (counted_s - begin_s) * scene.run.duration_s;
}

}  // namespace sonoglide::loop
