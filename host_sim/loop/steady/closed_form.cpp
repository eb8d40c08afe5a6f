#include "host_sim/loop/steady/requirement.hpp"

#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <cmath>

#include "host_sim/configure/friction/mean_friction.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/loop/steady/root.hpp"

namespace sonoglide::steady {

double closed_form_ratio(const scene::Scene& scene, double sliding_m_per_s,
                         double vibration_m_per_s) {
  return configure::mean_friction_ratio(scene.friction, scene.drive->rate_rad_per_s(),
                                        sliding_m_per_s, vibration_m_per_s);
}

/// The first step of a scan over the vibration that leads below the ratio, then a root in it; where
/// none does, the minimum about the lowest place.
RequiredVibration closed_form_vibration(const scene::Scene& scene, double sliding_m_per_s,
                                        double ratio) {
  constexpr int steps = 120;
  constexpr double most = 1e6;
  const auto [least_m_per_s, opening_m_per_s] =
      configure::vibration_range(scene.friction, scene.drive->rate_rad_per_s(), sliding_m_per_s);
  const double most_m_per_s = std::min(opening_m_per_s, most * sliding_m_per_s);
  const double span = std::log(most_m_per_s / least_m_per_s);
  const auto vibration_m_per_s = [&](double place) {
    return most_m_per_s * std::exp(span * (place / steps - 1.0));
  };
  const auto excess_under = [&](double velocity_m_per_s) {
    return closed_form_ratio(scene, sliding_m_per_s, velocity_m_per_s) - ratio;
  };
  const auto excess = [&](double place) { return excess_under(vibration_m_per_s(place)); };
  double lowest = 0.0;
  double lowest_excess = excess(0.0);
  for (int i = 1; i <= steps && lowest_excess >= 0.0; ++i) {
    const double here = excess(i);
    if (here < lowest_excess) {
      lowest = i;
      lowest_excess = here;
    }
  }
  if (lowest_excess >= 0.0) {
    constexpr int minimum_bits = 26;
    const auto [place, least] = boost::math::tools::brent_find_minima(
        excess, std::max(0.0, lowest - 1.0), std::min(lowest + 1.0, double{steps}), minimum_bits);
    if (least < lowest_excess) {
      lowest = place;
      lowest_excess = least;
    }
  }
  if (lowest_excess >= 0.0 || lowest == 0.0) {
    return {ratio + std::max(0.0, lowest_excess), vibration_m_per_s(lowest)};
  }
  return {ratio, root_between(excess_under, vibration_m_per_s(std::ceil(lowest) - 1.0),
                              vibration_m_per_s(lowest))};
}

double force_N(const scene::Scene& scene, double vibration_m_per_s) {
  const double omega = scene.drive->rate_rad_per_s();
  return configure::dynamic_stiffness_N_per_m(scene.plant, omega) * vibration_m_per_s / omega;
}

}  // namespace sonoglide::steady
