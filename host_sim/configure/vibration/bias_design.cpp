#include "host_sim/configure/vibration/bias_design.hpp"

#include <fmt/format.h>

#include <complex>

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/turn.hpp"
#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/scene/bound.hpp"

namespace sonoglide::configure {
namespace {

/// Of the largest stable part: 0.35 with a delay of one period, where it is 0.83.
constexpr double taken = 0.42;

double cos_of_turns(double turns) {
  return 1.0 - 2.0 * numeric::sin_pi(turns) * numeric::sin_pi(turns);
}

/// From the period whose mean velocity is known to the answer's. The sensorless loop predicts the mode
/// through its delay and could answer as if there were none; what its observer lags behind is taken for
/// a period.
int delay_periods(const scene::Scene& scene) {
  return scene.sensor.vibration || !scene.controller->vibration ? scene.drive->delay_periods : 1;
}

}  // namespace

double fastest_biased_mode(int delay_periods) {
  return 0.25 / (delay_periods + 1);
}

double largest_bias_part(double natural_per_carrier, int delay_periods) {
  const double angle = numeric::two_pi * natural_per_carrier;
  const double edge = fastest_biased_mode(delay_periods);
  const double half_sine = numeric::sin_pi(natural_per_carrier);
  const double per_displacement = angle * angle / (2.0 * half_sine * half_sine);
  return per_displacement * (cos_of_turns(natural_per_carrier) - cos_of_turns(edge)) /
         numeric::sin_pi(2.0 * edge);
}

double wanted_bias_N(const scene::Scene& scene, const NominalPlant& plant) {
  const scene::Drive& drive = *scene.drive;
  const double natural_per_carrier = plant.natural_rad_per_s() / drive.rate_rad_per_s();
  const double part = taken * largest_bias_part(natural_per_carrier, delay_periods(scene));
  return 2.0 * plant.friction_N +
         part * natural_per_carrier * drive.max_force_amplitude_N / numeric::two_pi;
}

BiasDesign design_bias(const scene::Scene& scene, const NominalPlant& plant,
                       const Resonator& resonator, double force_N) {
  const int delay = delay_periods(scene);
  const double natural = numeric::sqrt(resonator.stiffness) / numeric::two_pi;
  if (!(natural < fastest_biased_mode(delay))) {
    throw ConfigurationError(
        "drive.bias_limit_N",
        fmt::format(
            "is of no use: the natural mode is at {:.3g} of the carrier frequency, and with a delay "
            "of {} carrier periods a bias damps one that is under {:.3g}; allowed: 0",
            natural, delay, fastest_biased_mode(delay)));
  }
  BiasDesign design;
  design.limit_N = scene.drive->bias_limit_N;
  design.natural = natural;
  design.per_force = force_N / design.limit_N;
  if (!scene.controller->vibration) {
    return design;
  }
  design.part = taken * largest_bias_part(natural, delay);
  const double push =
      resonator.push * design.limit_N / (scene.max_drive_force_N() * plant.force_factor);
  design.gain = design.part / push;
  const std::complex<double> rate = rate_of(resonator);
  design.per_mode = push / rate.imag();
  const std::complex<double> mean = mean_of_exponential(rate);
  design.mean_of_first = mean.real();
  design.mean_of_second = -mean.imag();
  return design;
}

}  // namespace sonoglide::configure
