#include "host_sim/configure/vibration/recommended_means.hpp"

#include <cmath>

namespace sonoglide::configure {
namespace {

ModeKind kind_of(double natural_per_carrier, bool along) {
  constexpr double beside_multiple = 0.1;
  constexpr double beside_half = 0.02;
  constexpr double fast_mode = 3.0;
  constexpr double unquiet_from = 3.2;
  constexpr double unquiet_to = 3.5;
  if (!along) {
    return ModeKind::across;
  }
  if (natural_per_carrier < slow_mode) {
    return natural_per_carrier > told_mode ? ModeKind::slow : ModeKind::slowest;
  }
  const double nearest = std::round(natural_per_carrier);
  if (nearest >= 2.0 && std::abs(natural_per_carrier - nearest) < beside_multiple) {
    return nearest == 2.0 ? ModeKind::twice : ModeKind::multiple;
  }
  if (natural_per_carrier > fast_mode) {
    const bool unquiet = unquiet_from <= natural_per_carrier && natural_per_carrier < unquiet_to;
    return unquiet ? ModeKind::unquiet : ModeKind::fast;
  }
  const double part = natural_per_carrier - std::floor(natural_per_carrier);
  return std::abs(part - 0.5) < beside_half ? ModeKind::half_turn : ModeKind::other;
}

/// Of the natural frequency: that of a stiffness off by 6 %.
constexpr double unquiet_range = 0.03;

/// Of a ramp.
int codes_per_period(ModeKind kind) {
  return kind == ModeKind::twice ? 2 : 8;
}

}  // namespace

RecommendedMeans recommended_means(double natural_per_carrier, bool along) {
  RecommendedMeans means;
  means.kind = kind_of(natural_per_carrier, along);
  means.sensorless = means.kind == ModeKind::slow || means.kind == ModeKind::other;
  means.biased = means.kind == ModeKind::slow || means.kind == ModeKind::slowest;
  means.codes_per_period = means.ramped() ? codes_per_period(means.kind) : 1;
  means.shaping_range = means.kind == ModeKind::unquiet ? unquiet_range : 0.0;
  return means;
}

std::string_view reason(ModeKind kind) {
  switch (kind) {
    case ModeKind::across:
      return "the friction along the sliding does not show the vibration";
    case ModeKind::slowest:
      return "no reading tells this mode from the vibration, and a balance of the friction needs none";
    case ModeKind::slow:
      return "the balance keeps the mode from moving, and the observer quiets what is left";
    case ModeKind::twice:
      return "the jumps of two codes a period hardly excite the mode, whatever the stiffness";
    case ModeKind::multiple:
      return "the ramp hardly excites the mode, whatever the stiffness";
    case ModeKind::unquiet:
      return "the ramp alone leaves 5 % of a jump here, and a robust notch quiets that";
    case ModeKind::fast:
      return "the observer finds this mode only where the stiffness is known to 3 %, and the ramp hardly "
             "excites it, whatever the stiffness";
    case ModeKind::half_turn:
      return "the mode turns by about half a turn a period, so that its direction of rotation cannot be "
             "observed";
    case ModeKind::other:
      break;
  }
  return "the observer finds a mode whose stiffness is off";
}

}  // namespace sonoglide::configure
