#include <algorithm>
#include <cmath>

#include "firmware/control/interface/drive_command.hpp"
#include "host_sim/report/step_metrics.hpp"

namespace sonoglide::report {
namespace {

constexpr int settling_periods = 10;

bool is_free(const loop::Period& period) {
  const bool driven = control::drives(period.state);
  const bool limited =
      period.limit == control::Limit::actuator || period.limit == control::Limit::slew ||
      period.limit == control::Limit::voltage || period.limit == control::Limit::current ||
      period.limit == control::Limit::frequency_range ||
      period.limit == control::Limit::velocity_at_rail;
  return driven && !limited;
}

}  // namespace

TrackingMeter::TrackingMeter(const scene::Scene& scene, double speed_floor_m_per_s)
    : cursor_(scene), unit_(target_unit(scene)), speed_floor_m_per_s_(speed_floor_m_per_s) {}

void TrackingMeter::take(const loop::Period& period) {
  const std::size_t index = cursor_.span_of(period);
  if (index == SpanCursor::none) {
    return;
  }
  if (index != span_) {
    span_ = index;
    free_periods_ = 0;
  }
  if (!is_free(period)) {
    free_periods_ = 0;
    return;
  }
  free_periods_ = std::min(free_periods_ + 1, settling_periods + 1);
  const double slowest_m_per_s =
      std::min(std::abs(period.begin_velocity_m_per_s), std::abs(period.end_velocity_m_per_s));
  if (free_periods_ > settling_periods && slowest_m_per_s >= speed_floor_m_per_s_) {
    const double error = std::abs(unit_.held(period) - cursor_.spans()[index].target);
    largest_ = std::max(largest_.value_or(0.0), error);
  }
}

}  // namespace sonoglide::report
