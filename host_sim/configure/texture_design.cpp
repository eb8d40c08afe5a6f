#include "host_sim/configure/control_design.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/configure/design_steps.hpp"
#include "host_sim/scene/bound.hpp"

namespace sonoglide::configure {
namespace {

constexpr const char* texture_key = "controller.target_texture";

/// Controller steps until the answer to the sample that comes next has its effect.
double lead_steps(const ControlDesign& design) {
  constexpr double until_it_comes = 1.0;
  return until_it_comes + design.lead_periods;
}

/// A step at full speed is a part of a period that app::TexturePath can add, and one at the fastest
/// sliding is short against a period.
void require_resolved(const scene::Texture& texture, double fastest_m_per_s,
                      const ControlDesign& design) {
  constexpr double steps_at_fastest = 8.0;
  constexpr double largest_step = 8.0;
  constexpr double longest_lead = 32.0;
  const double step_s = design.scales.step_period_s();
  const double full_m = design.scales.velocity_m_per_s * step_s;
  const double least_m =
      std::max({steps_at_fastest * fastest_m_per_s * step_s, full_m / largest_step,
                full_m * lead_steps(design) / longest_lead});
  const double most_m = std::ldexp(full_m, 27);
  if (!(texture.period_m >= least_m && texture.period_m <= most_m)) {
    throw ConfigurationError(
        texture_key,
        fmt::format("a period_m of {:g} m is too {} for steps of {:.3g} s at {:g} m/s; allowed: "
                    "{} to {} m",
                    texture.period_m, texture.period_m < least_m ? "short" : "long", step_s,
                    fastest_m_per_s, scene::at_least(least_m), scene::at_most(most_m)));
  }
}

/// Q15 resolves little of a small change.
void require_told_apart(const scene::Scene& scene, const scene::Texture& texture,
                        const ControlDesign& design) {
  constexpr double fewest = 32.0;
  const auto [lowest, highest] = std::minmax_element(texture.values.begin(), texture.values.end());
  const double one =
      std::ldexp(texture.of_force ? design.scales.force_N : 2.0, -15);  // as a controller takes it
  const double change = *highest - *lowest;
  if (scene.controller->arithmetic == scene::Arithmetic::q15 && change > 0.0 &&
      change < fewest * one) {
    throw ConfigurationError(
        texture_key,
        fmt::format("changes by {:g}, of which \"q15\" resolves {:.3g}; allowed: changes of at "
                    "least {}, or another controller.arithmetic",
                    change, one, scene::at_least(fewest * one)));
  }
}

/// @param advance  of the path, in periods, of a step at full speed
void set_path(double advance, const ControlDesign& design, TextureDesign& texture) {
  // The largest weight with a period of at most 2^59.
  const int exponent = 28 + static_cast<int>(std::floor(std::log2(advance)));
  texture.weight = std::uint32_t{1} << static_cast<unsigned>(exponent);
  const double period = std::ldexp(1.0 / advance, 31 + exponent);
  texture.period = static_cast<std::int64_t>(std::llround(period));
  // Rounded down: of the last digits of a double none is left.
  texture.inverse = static_cast<std::uint32_t>(
      std::min(std::ldexp(1.0 / period, 90) * (1.0 - 0x1p-50), 4294967295.0));
  texture.lead =
      static_cast<std::uint32_t>(std::llround(std::ldexp(advance * lead_steps(design), 27)));
}

/// What the vibration velocity can change by in a step, per unit of it.
struct SlopeBound {
  double at_rest;  ///< 0: no bound
  double losses;   ///< that help it down and hinder it up, per unit of velocity
  control::Limit limit;

  double of(double velocity, bool up) const {
    return std::max(1e-9, at_rest * (up ? 1.0 - losses * velocity : 1.0 + losses * velocity));
  }
};

SlopeBound slope_bound(const ControlDesign& design) {
  if (const ResonantDesign* resonance = design.resonance()) {
    return {resonance->rate, resonance->losses, control::Limit::voltage};
  }
  return {design.slew_limited ? design.slew_per_period : 0.0, 0.0, control::Limit::slew};
}

/// What the texture means at the fastest sliding, over what the drive can.
struct Demand {
  double change = 0.0;     ///< of the vibration in a step
  double vibration = 0.0;  ///< itself
};

Demand demand(const scene::Texture& texture, double fastest_m_per_s, const SlopeBound& bound,
              const ControlDesign& design) {
  if (bound.at_rest == 0.0) {
    return {};
  }
  const double friction_N = design.friction_force * design.scales.force_N;
  const VibrationMap map = design.vibration_map(friction_N);
  const double step_m = fastest_m_per_s * design.scales.step_period_s();
  constexpr double least = 256.0;
  constexpr double most = 4096.0;
  const auto count =
      static_cast<std::size_t>(std::clamp(std::ceil(texture.period_m / step_m), least, most));
  const double spacing_m = texture.period_m / static_cast<double>(count);
  const auto velocity = [&](double distance_m) {
    const double target = texture.at(distance_m);
    const double ratio = texture.of_force ? std::min(1.0, target / friction_N) : target;
    return map.velocity_m_per_s(ratio, fastest_m_per_s) / design.scales.velocity_m_per_s;
  };
  Demand largest;
  double before = velocity(0.0);
  for (std::size_t i = 1; i <= count; ++i) {
    const double now = velocity(spacing_m * static_cast<double>(i));
    const double change = std::abs(now - before) * step_m / spacing_m;
    largest.change =
        std::max(largest.change, change / bound.of(std::max(before, now), now > before));
    largest.vibration = std::max(largest.vibration, bound.losses * now);
    before = now;
  }
  return largest;
}

}  // namespace

void design_texture(const scene::Scene& scene, ControlDesign& design) {
  if (!scene.controller->texture) {
    return;
  }
  const scene::Texture& texture = *scene.controller->texture;
  const double fastest_m_per_s = scene.sliding.fastest_m_per_s();
  require_resolved(texture, fastest_m_per_s, design);
  require_told_apart(scene, texture, design);
  TextureDesign& found = design.texture.emplace();
  found.values = texture.values;
  set_path(design.scales.velocity_m_per_s * design.scales.step_period_s() / texture.period_m,
           design, found);
  const SlopeBound bound = slope_bound(design);
  const Demand demanded = demand(texture, fastest_m_per_s, bound, design);
  found.overload = demanded.change;
  found.vibration_demand = demanded.vibration;
  found.fastest_m_per_s = fastest_m_per_s;
  found.limit = bound.limit;
}

}  // namespace sonoglide::configure
