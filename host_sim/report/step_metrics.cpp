#include "host_sim/report/step_metrics.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "firmware/control/interface/drive_command.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/report/self_excitation.hpp"
#include "host_sim/scene/friction_laws.hpp"

namespace sonoglide::report {
namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

/// Of a settled step none, unless it was named in most periods: one from before may still end.
control::Limit prevailing_limit(std::array<std::uint64_t, control::limit_count> count,
                                bool settled) {
  auto& unlimited = count[static_cast<std::size_t>(control::Limit::none)];
  if (settled && 2 * unlimited >= std::accumulate(count.begin(), count.end(), std::uint64_t{0})) {
    return control::Limit::none;
  }
  unlimited = 0;
  const auto most = std::max_element(count.begin(), count.end());
  return *most == 0 ? control::Limit::none
                    : static_cast<control::Limit>(std::distance(count.begin(), most));
}

/// Of a contact whose friction may rise again under more vibration, and whose closed form holds.
bool may_have_least_friction(const scene::Scene& scene) {
  return !scene.load && scene.profile_key() == nullptr &&
         scene.drive->waveform == scene::Waveform::cosine &&
         scene::friction_map(scene.friction.law) == scene::FrictionMap::tabulated;
}

}  // namespace

StepMeter::StepMeter(const scene::Scene& scene, const configure::ControlDesign& design)
    : cursor_(scene),
      unit_(target_unit(scene)),
      band_(scene.run.settling_band),
      tells_mismatch_(scene.sensor.force && design.estimates_mismatch),
      senses_force_(scene.sensor.force),
      observes_vibration_(scene.sensor.vibration),
      resonant_(scene.resonant()),
      may_excite_itself_(may_excite_itself(scene) ? std::optional(scene) : std::nullopt),
      has_least_friction_(may_have_least_friction(scene) ? std::optional(scene) : std::nullopt),
      largest_current_A_(scene.drive->max_current_amplitude_A),
      learning_from_s_(0.5 * scene.controller->calibration_s.value_or(0.0)),
      learning_until_s_(scene.controller->calibration_s.value_or(0.0)) {
  for (const TargetSpan& span : cursor_.spans()) {
    Tally tally;
    tally.settled_s = span.begin_s;
    tally.velocity_settled_s = span.begin_s;
    tallies_.push_back(tally);
  }
}

void StepMeter::take(const loop::Period& period) {
  if (period.begin_s >= learning_from_s_ && period.end_s <= learning_until_s_ &&
      std::isfinite(period.friction_ratio)) {
    calibration_.lowest = std::min(calibration_.lowest, period.friction_ratio);
    calibration_.highest = std::max(calibration_.highest, period.friction_ratio);
  }
  const std::size_t index = cursor_.span_of(period);
  if (index == SpanCursor::none) {
    return;
  }
  take_pause(period);
  if (pausing_) {
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

PauseMetrics StepMeter::pauses() const {
  if (paused_periods_ == 0) {
    return {};
  }
  const auto all = static_cast<double>(periods_);
  const auto driven = static_cast<double>(periods_ - paused_periods_);
  return {pauses_, paused_periods_, static_cast<double>(paused_periods_) / all,
          sum_ / all - (sum_ - paused_sum_) / driven};
}

void StepMeter::take_pause(const loop::Period& period) {
  const bool pausing = period.state == control::State::relearning;
  pauses_ += pausing && !pausing_ ? 1 : 0;
  pausing_ = pausing;
  paused_periods_ += pausing ? 1 : 0;
  paused_sum_ += pausing ? period.friction_ratio : 0.0;
  sum_ += period.friction_ratio;
  ++periods_;
}

void StepMeter::take_any(const loop::Period& period, const TargetSpan& span, Tally& tally) const {
  const double error = unit_.held(period) - span.target;
  if (!(std::abs(error) <= band_)) {
    tally.settled_s = period.end_s;
  }
  if (period.target / unit_.size == span.target) {  // else still driven for the target before
    tally.overshoot = std::max(tally.overshoot, span.target < span.previous ? -error : error);
  }
  if (observes_vibration_) {
    constexpr double velocity_band = 0.02;
    const double wanted_m_per_s = period.wanted_vibration_m_per_s;
    tally.velocity_wanted = tally.velocity_wanted || wanted_m_per_s > 0.0;
    if (!(std::abs(std::abs(period.vibration_m_per_s) - wanted_m_per_s) <=
          velocity_band * wanted_m_per_s)) {
      tally.velocity_settled_s = period.end_s;
    }
  }
  if (largest_current_A_ && period.whole) {
    tally.current_A = std::max(tally.current_A, std::abs(period.current_A));
  }
  tally.last_end_s = period.end_s;
  ++tally.periods;
}

void StepMeter::take_steady(const loop::Period& period, Tally& tally) const {
  const double held = unit_.held(period);
  // A period in which the sliding turns has no ratio.
  if (std::isfinite(held)) {
    tally.held_sum += held;
    ++tally.held_periods;
  }
  tally.drive_sum_N += period.drive_amplitude_N;
  tally.lowest = std::min(tally.lowest, held);
  tally.highest = std::max(tally.highest, held);
  ++tally.limit_count[static_cast<std::size_t>(period.limit)];
  tally.fault = tally.fault || period.state == control::State::fault;
  tally.open = tally.open || period.open_fraction > 0.0;
  if (period.settling == control::Settling::settled) {
    ++tally.settled_periods;
    tally.mismatch_sum += period.commanded_ratio / period.target_ratio;
  }
  if (period.limit == control::Limit::not_settling) {
    tally.cause = period.settling;
  }
  if (observes_vibration_) {
    tally.velocity_sum_m_per_s += std::abs(period.vibration_m_per_s);
  }
  if (resonant_) {
    tally.frequency_sum_Hz += period.frequency_Hz;
    tally.frequency_error =
        std::max(tally.frequency_error, std::abs(period.frequency_Hz / period.natural_Hz - 1.0));
  }
  ++tally.steady_periods;
}

/// Whether what is in its band from this time on has settled: that lasts for a tenth of the span.
bool StepMeter::stays(double since_s, const TargetSpan& span, const Tally& tally) {
  constexpr double least_part = 0.1 * (1.0 - 1e-9);  // times are sums of periods, rounded
  return tally.periods > 0 && since_s < tally.last_end_s &&
         tally.last_end_s - since_s >= least_part * (span.end_s - span.begin_s);
}

/// Without a force sensor the controller takes a held vibration for a ratio on target.
bool StepMeter::holds_blindly(const TargetSpan& span, const Tally& tally) const {
  return !senses_force_ && tally.velocity_wanted && stays(tally.velocity_settled_s, span, tally);
}

StepMetrics StepMeter::metrics(const TargetSpan& span, const Tally& tally) const {
  const bool settled = stays(tally.settled_s, span, tally);
  const auto count = static_cast<double>(tally.steady_periods);  // none: the means are NaN
  StepMetrics metrics;
  metrics.time_s = span.step_s;
  metrics.target = span.target;
  if (settled) {
    metrics.settling_time_s = tally.settled_s - span.begin_s;
  }
  metrics.overshoot = tally.periods > 0 ? tally.overshoot : undefined;
  metrics.steady_error = tally.held_sum / static_cast<double>(tally.held_periods) - span.target;
  metrics.ripple = tally.lowest <= tally.highest ? 0.5 * (tally.highest - tally.lowest) : undefined;
  metrics.drive_amplitude_N = tally.drive_sum_N / count;
  metrics.limit = prevailing_limit(tally.limit_count, settled);
  if (metrics.limit == control::Limit::not_settling) {
    metrics.cause = tally.cause;
  }
  // A loop without a vibration sensor reports no ratio.
  if (tally.mismatch_sum > 0.0 && tells_mismatch_) {
    metrics.mismatch = tally.mismatch_sum / static_cast<double>(tally.settled_periods);
  }
  if (!settled && metrics.limit == control::Limit::none && !tally.fault) {
    name_unseen_limit(span, tally, metrics);
  }
  if (!settled) {
    name_self_excitation(span, metrics);
  }
  if (observes_vibration_) {
    metrics.vibration = vibration_metrics(span, tally);
  }
  if (!settled) {
    name_least_friction(span, metrics);
  }
  name_passed_bound(tally, metrics);
  if (resonant_) {
    metrics.resonance = resonance_metrics(tally);
  }
  return metrics;
}

VibrationMetrics StepMeter::vibration_metrics(const TargetSpan& span, const Tally& tally) {
  VibrationMetrics metrics;
  metrics.velocity_m_per_s = tally.velocity_sum_m_per_s / static_cast<double>(tally.steady_periods);
  if (tally.velocity_wanted && stays(tally.velocity_settled_s, span, tally)) {
    metrics.settling_time_s = tally.velocity_settled_s - span.begin_s;
  }
  return metrics;
}

ResonanceMetrics StepMeter::resonance_metrics(const Tally& tally) {
  ResonanceMetrics metrics;
  metrics.frequency_Hz = tally.frequency_sum_Hz / static_cast<double>(tally.steady_periods);
  metrics.frequency_error = tally.steady_periods > 0 ? tally.frequency_error : undefined;
  return metrics;
}

std::vector<StepMetrics> measured_steps(const scene::Scene& plant,
                                        const configure::ControlDesign& design) {
  StepMeter meter(plant, design);
  loop::Watch watch;
  watch.periods.push_back(&meter);
  watch.energies = false;
  loop::run(plant, design, watch);
  return meter.steps();
}

}  // namespace sonoglide::report
