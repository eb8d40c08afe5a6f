#include "host_sim/studies/paper/dong_dapino.hpp"

#include "firmware/friction/normal_vibration_ratio.hpp"
#include "firmware/numeric/turn.hpp"

namespace sonoglide::paper {
namespace {

constexpr double frequency_Hz = 22e3;
constexpr Range amplitudes_m = {0.5e-6, 5e-6};
constexpr Range coefficients = {0.1, 0.8};
constexpr double poisson_number = 0.3;
/// R. D. Mindlin, Journal of Applied Mechanics 16 (1949) 259-268.
constexpr double normal_by_tangential = (2.0 - poisson_number) / (2.0 - 2.0 * poisson_number);

double critical_velocity_m_per_s(double amplitude_m, double coefficient) {
  return coefficient * normal_by_tangential * numeric::two_pi * frequency_Hz * amplitude_m;
}

/// Of a vibration as large as the indentation.
double largest_reduction(double velocity_m_per_s, double critical_m_per_s) {
  return 1.0 - friction::normal_vibration_ratio(1.0, velocity_m_per_s / critical_m_per_s);
}

}  // namespace

Range dong_critical_velocities_m_per_s() {
  return {critical_velocity_m_per_s(amplitudes_m.least, coefficients.least),
          critical_velocity_m_per_s(amplitudes_m.most, coefficients.most)};
}

Range dong_normal(double velocity_m_per_s) {
  return {0.0, largest_reduction(velocity_m_per_s, dong_critical_velocities_m_per_s().most)};
}

NormalContact dong_contact() {
  const auto [slow, fast] = dong_velocities_m_per_s;
  const auto [at_slow, at_fast] = dong_reductions;
  // The quotient of the two reductions rises with the critical velocity, from 0 to 1.
  double low = fast;
  double high = 1e6 * fast;
  while (high - low > 1e-12 * high) {
    const double middle = 0.5 * (low + high);
    const double quotient = largest_reduction(fast, middle) / largest_reduction(slow, middle);
    (quotient < at_fast / at_slow ? low : high) = middle;
  }
  return {low, at_slow / largest_reduction(slow, low)};
}

}  // namespace sonoglide::paper
