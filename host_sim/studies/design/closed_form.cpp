#include "host_sim/studies/design/closed_form.hpp"

#include <boost/math/tools/minima.hpp>

#include <cmath>

#include "firmware/friction/coulomb_friction_ratio.hpp"
#include "firmware/friction/dahl_friction_ratio.hpp"
#include "firmware/friction/stribeck_friction_ratio.hpp"
#include "firmware/numeric/turn.hpp"
#include "host_sim/configure/plant_scales.hpp"

namespace sonoglide::design {

double closed_form_ratio(const scene::Scene& scene, double sliding_m_per_s,
                         double vibration_m_per_s) {
  const scene::Friction& friction = scene.friction;
  const double velocity_ratio = sliding_m_per_s / vibration_m_per_s;
  if (scene::is<scene::laws::Dahl>(friction.law)) {
    const double amplitude_m = vibration_m_per_s / (numeric::two_pi * scene.drive->frequency_Hz);
    return friction::dahl_friction_ratio(
        velocity_ratio, friction.contact_stiffness_N_per_m * amplitude_m / friction.limit_N());
  }
  if (const auto* curve = std::get_if<scene::laws::Stribeck>(&friction.law)) {
    const double v = vibration_m_per_s;
    const double over_limit = friction::stribeck_friction_ratio(
        velocity_ratio, curve->fall_s_per_m * v / friction.coefficient,
        curve->rise_s3_per_m3 * v * v * v / friction.coefficient);
    return over_limit * friction.limit_N() / curve->undriven_N(friction, sliding_m_per_s);
  }
  return friction::coulomb_friction_ratio(velocity_ratio);
}

RequiredVibration closed_form_vibration(const scene::Scene& scene, double sliding_m_per_s,
                                        double ratio) {
  constexpr double largest_logarithm = 13.8;  // of 10^6
  const auto excess = [&](double logarithm) {
    return closed_form_ratio(scene, sliding_m_per_s, sliding_m_per_s * std::exp(logarithm)) - ratio;
  };
  constexpr int minimum_bits = 26;
  const auto [place, least] =
      boost::math::tools::brent_find_minima(excess, 0.0, largest_logarithm, minimum_bits);
  if (least >= 0.0) {
    return {ratio + least, sliding_m_per_s * std::exp(place)};
  }
  return {ratio, sliding_m_per_s * std::exp(root_between(excess, 0.0, place))};
}

double force_N(const scene::Scene& scene, double vibration_m_per_s) {
  const double omega = numeric::two_pi * scene.drive->frequency_Hz;
  return configure::dynamic_stiffness_N_per_m(scene.plant, omega) * vibration_m_per_s / omega;
}

}  // namespace sonoglide::design
