#include "host_sim/analysis/step_metrics.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sonoglide::analysis {
namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

template <std::size_t Limits>
control::Limit prevailing_limit(std::array<std::uint64_t, Limits> count) {
  count[static_cast<std::size_t>(control::Limit::none)] = 0;
  const auto most = std::max_element(count.begin(), count.end());
  return *most == 0 ? control::Limit::none
                    : static_cast<control::Limit>(std::distance(count.begin(), most));
}

}  // namespace

StepMeter::StepMeter(const scene::Scene& scene) : cursor_(scene), band_(scene.run.settling_band) {
  for (const TargetSpan& span : cursor_.spans()) {
    Tally tally;
    tally.settled_s = span.begin_s;
    tallies_.push_back(tally);
  }
}

void StepMeter::take(const loop::Period& period) {
  const std::size_t index = cursor_.span_of(period);
  if (index == SpanCursor::none) {
    return;
  }
  const TargetSpan& span = cursor_.spans()[index];
  take_any(period, span, tallies_[index]);
  if (cursor_.in_last_quarter(period, span)) {
    take_steady(period, tallies_[index]);
  }
}

std::vector<StepMetrics> StepMeter::steps() const {
  std::vector<StepMetrics> all;
  for (std::size_t i = 0; i < tallies_.size(); ++i) {
    all.push_back(metrics(cursor_.spans()[i], tallies_[i]));
  }
  return all;
}

void StepMeter::take_any(const loop::Period& period, const TargetSpan& span, Tally& tally) const {
  const double error = period.friction_ratio - span.target;
  if (!(std::abs(error) <= band_)) {
    tally.settled_s = period.end_s;
  }
  if (period.target == span.target) {  // else still driven for the target before
    tally.overshoot = std::max(tally.overshoot, span.target < span.previous ? -error : error);
  }
  tally.last_end_s = period.end_s;
  ++tally.periods;
}

void StepMeter::take_steady(const loop::Period& period, Tally& tally) {
  tally.ratio_sum += period.friction_ratio;
  tally.drive_sum_N += period.drive_amplitude_N;
  tally.lowest = std::min(tally.lowest, period.friction_ratio);
  tally.highest = std::max(tally.highest, period.friction_ratio);
  ++tally.limit_count[static_cast<std::size_t>(period.limit)];
  ++tally.steady_periods;
}

StepMetrics StepMeter::metrics(const TargetSpan& span, const Tally& tally) {
  const bool settled = tally.periods > 0 && tally.settled_s < tally.last_end_s;
  const auto count = static_cast<double>(tally.steady_periods);  // none: the means are NaN
  return {span.step_s,
          span.target,
          settled ? std::optional<double>(tally.settled_s - span.begin_s) : std::nullopt,
          tally.periods > 0 ? tally.overshoot : undefined,
          tally.ratio_sum / count - span.target,
          tally.steady_periods > 0 ? 0.5 * (tally.highest - tally.lowest) : undefined,
          tally.drive_sum_N / count,
          prevailing_limit(tally.limit_count)};
}

}  // namespace sonoglide::analysis
