#include "host_sim/configure/vibration/ramp_design.hpp"

#include <algorithm>
#include <optional>

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/turn.hpp"
#include "host_sim/configure/design_steps.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/configure/vibration/mode_model.hpp"
#include "host_sim/configure/vibration/sensorless_reading.hpp"

namespace sonoglide::configure {
namespace {

/// Half the swing of the friction ratio, of the target that swings most, under a free vibration as
/// large as the forced one in displacement.
double largest_swing(const scene::Scene& scene, const NominalPlant& plant,
                     const ControlDesign& design, double rotation) {
  constexpr double barely_sliding = 0.95;  // velocity ratio: beyond it a swing is not small
  const double sliding_m_per_s = scene.sliding.fastest_m_per_s();
  const FrictionReading reading = friction_reading(scene, plant, design.scales.velocity_m_per_s);
  const VibrationMap map = design.vibration_map(design.friction_force * design.scales.force_N);
  double largest = 0.0;
  for (const double target : plant.target_ratios(*scene.controller)) {
    const double velocity_m_per_s = map.velocity_m_per_s(target, sliding_m_per_s);
    if (velocity_m_per_s > 0.0) {
      const double ratio = std::min(barely_sliding, sliding_m_per_s / velocity_m_per_s);
      largest = std::max(largest, ratio_swing(reading.contact(ratio, 0.0), rotation));
    }
  }
  return largest * rotation / numeric::two_pi;
}

/// A mode under a drive, ramped or not.
class DrivenMode {
 public:
  DrivenMode(const scene::Scene& scene, const NominalPlant& plant, const ControlScales& scales)
      : mode_(natural_mode(plant, scales.carrier_period_s)),
        step_mode_(natural_mode(plant, scales.step_period_s())),
        damping_(plant.damping_N_s_per_m / plant.mass_kg * scales.carrier_period_s),
        ramped_(scene.drive->interpolation == scene::Interpolation::linear),
        parts_(scene.drive->codes_per_period),
        range_(assumed_frequency_range(scene)) {}

  /// Over a carrier period.
  const NaturalMode& mode() const { return mode_; }
  /// Over a step of the controller, which the taps of a notch are apart.
  const NaturalMode& step_mode() const { return step_mode_; }
  double range() const { return range_; }

  /// That of a jump is 1.
  double nominal_kick() const { return kick(1.0); }

  /// The most of a jump's free vibration that is left within the range.
  double left(const std::optional<NotchDesign>& notch) const {
    constexpr int points = 32;  // on either side
    const auto left_at = [&](double factor) {
      return kick(factor) * (notch ? notch_ripple_at(*notch, step_mode_, factor) : 1.0);
    };
    double most = left_at(1.0);
    for (int i = -points; i <= points && range_ > 0.0; ++i) {
      most = std::max(most, left_at(1.0 + range_ * i / points));
    }
    constexpr double rounding = 1e-12;
    return most < rounding ? 0.0 : most;
  }

 private:
  double kick(double factor) const {
    if (!ramped_) {
      return 1.0;
    }
    const double rotation = mode_.rotation * factor;
    return ramp_kick({rotation * rotation + 0.25 * damping_ * damping_, damping_, 1.0}, parts_);
  }

  NaturalMode mode_;
  NaturalMode step_mode_;
  double damping_;
  bool ramped_;
  int parts_;
  double range_;
};

/// Half of a jump's kick is hardly less than that.
bool is_ramp(double kick) {
  return kick < 0.5;
}

/// In periods of the controller: a longer one holds the feedback up for more than it takes off.
constexpr int longest_beside_a_ramp = max_notch_span / 2;

/// @param accepted  to be left
std::optional<NotchDesign> chosen_notch(const DrivenMode& driven, double accepted) {
  const bool ramp = is_ramp(driven.nominal_kick());
  const double by_ramp = driven.left({});
  if (ramp && by_ramp <= accepted) {
    return std::nullopt;
  }
  std::optional<NotchDesign> best;
  double least = ramp ? 0.5 * by_ramp : by_ramp;
  const auto consider = [&](const std::optional<NotchDesign>& notch) {
    if (!notch || (ramp && notch->span() > longest_beside_a_ramp)) {
      return false;
    }
    const double left = driven.left(notch);
    if (left <= accepted || left < least) {
      best = notch;
      least = left;
    }
    return left <= accepted;
  };
  if (!consider(design_notch(driven.step_mode())) && driven.range() > 0.0) {
    consider(design_robust_notch(driven.step_mode(), driven.range()));
  }
  return best;
}

Quieting quieting_of(bool ramp, bool notch) {
  if (ramp) {
    return notch ? Quieting::ramp_and_notch : Quieting::ramp;
  }
  return notch ? Quieting::notch : Quieting::nothing;
}

}  // namespace

double assumed_frequency_range(const scene::Scene& scene) {
  constexpr double without_tolerances = 0.01;
  const double range = natural_frequency_range(scene.tolerances);
  return range > 0.0 ? std::min(range, scene::most_shaping_range) : without_tolerances;
}

LeftBehind left_behind(const scene::Scene& scene, const NominalPlant& plant,
                       const ControlDesign& design, const std::optional<NotchDesign>& notch) {
  const DrivenMode driven(scene, plant, design.scales);
  const double rotation = driven.mode().rotation;
  if (!(rotation > 0.0)) {
    return {};
  }
  const double left = driven.left(notch);
  return {left, left * largest_swing(scene, plant, design, rotation)};
}

FeedforwardDesign design_ramped(const scene::Scene& scene, const NominalPlant& plant,
                                const ControlDesign& design) {
  FeedforwardDesign found;
  found.ramp_periods = 1.0 / design.scales.every_periods;
  const DrivenMode driven(scene, plant, design.scales);
  found.frequency_range = driven.range();
  if (!(driven.mode().rotation > 0.0)) {
    return found;
  }
  const double swing = largest_swing(scene, plant, design, driven.mode().rotation);
  if (scene.controller->shaping) {
    design_named_notch(scene, driven.step_mode(), found);
  } else {
    found.notch = chosen_notch(driven, scene.run.settling_band / swing);
  }
  found.left = driven.left(found.notch);
  found.ratio_swing = swing * found.left;
  found.quieting = quieting_of(is_ramp(driven.nominal_kick()), found.notch.has_value());
  return found;
}

}  // namespace sonoglide::configure
