#include "host_sim/configure/friction/least_vibration.hpp"

#include <algorithm>
#include <cmath>

#include "host_sim/configure/friction/mean_friction.hpp"

namespace sonoglide::configure {
namespace {

/// A quarter of an octave.
constexpr double scan_step = 1.189207115002721;

}  // namespace

LeastVibration::LeastVibration(const scene::Friction& contact, double carrier_rad_per_s,
                               double sliding_m_per_s, double strongest_m_per_s)
    : contact_(contact), omega_(carrier_rad_per_s), sliding_m_per_s_(sliding_m_per_s) {
  constexpr double least = 0x1p-5;
  constexpr double least_of_opening = 0x1p-11;
  const double opening_m_per_s = vibration_range(contact, omega_, sliding_m_per_s).most_m_per_s;
  opens_ = opening_m_per_s < strongest_m_per_s;
  most_m_per_s_ = opens_ ? opening_m_per_s : strongest_m_per_s;
  above_ = at(opens_ ? least_of_opening * most_m_per_s_ : least * sliding_m_per_s);
  below_ = above_;
  lowest_ = above_;
}

double LeastVibration::vibration_m_per_s(double ratio) {
  while (below_.ratio >= ratio && below_.velocity_m_per_s < most_m_per_s_) {
    advance();
  }
  if (below_.ratio >= ratio) {
    return lowest_.velocity_m_per_s;
  }
  if (above_.ratio >= ratio) {
    above_ = root(ratio);
  }
  return above_.velocity_m_per_s;
}

std::optional<double> LeastVibration::least_ratio() const {
  const bool ends = opens_ || lowest_.velocity_m_per_s < most_m_per_s_;
  return below_.velocity_m_per_s >= most_m_per_s_ && ends ? std::optional(lowest_.ratio)
                                                          : std::nullopt;
}

LeastVibration::Place LeastVibration::at(double velocity_m_per_s) const {
  return {velocity_m_per_s,
          mean_friction_ratio(contact_, omega_, sliding_m_per_s_, velocity_m_per_s)};
}

void LeastVibration::advance() {
  before_ = above_;
  above_ = below_;
  below_ = at(std::min(scan_step * below_.velocity_m_per_s, most_m_per_s_));
  if (below_.ratio < lowest_.ratio) {
    lowest_ = below_;
  } else if (above_.velocity_m_per_s == lowest_.velocity_m_per_s) {
    refine_lowest();
  }
}

/// The vertex of the parabola through the lowest place and its neighbours.
void LeastVibration::refine_lowest() {
  const double left = before_.ratio - above_.ratio;
  const double right = below_.ratio - above_.ratio;
  const double bend = left + right;
  if (!(before_.velocity_m_per_s < above_.velocity_m_per_s && left > 0.0 && bend > 0.0)) {
    return;
  }
  const double vertex = 0.5 * (left - right) / bend;  // in steps
  const Place place = at(above_.velocity_m_per_s * (1.0 + vertex * (scan_step - 1.0)));
  lowest_ = place.ratio < lowest_.ratio ? place : lowest_;
}

/// Between above_ and below_, by regula falsi (Illinois).
LeastVibration::Place LeastVibration::root(double ratio) const {
  constexpr double accuracy = 1e-4;
  constexpr int most_places = 40;
  Place low = above_;
  Place high = below_;
  double low_excess = low.ratio - ratio;
  double high_excess = high.ratio - ratio;
  int side = 0;
  for (int i = 0; i < most_places; ++i) {
    const double part = low_excess / (low_excess - high_excess);
    const Place place =
        at(low.velocity_m_per_s + part * (high.velocity_m_per_s - low.velocity_m_per_s));
    const double excess = place.ratio - ratio;
    if (std::abs(excess) <= accuracy) {
      return place;
    }
    if (excess > 0.0) {
      low = place;
      low_excess = excess;
      high_excess *= side > 0 ? 0.5 : 1.0;
      side = 1;
    } else {
      high = place;
      high_excess = excess;
      low_excess *= side < 0 ? 0.5 : 1.0;
      side = -1;
    }
  }
  return high;
}

}  // namespace sonoglide::configure
