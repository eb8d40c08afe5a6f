#include "host_sim/report/run_findings.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "firmware/numeric/turn.hpp"

namespace sonoglide::report {
namespace {

constexpr double samples_per_period = 64.0;
constexpr std::uint64_t close_up_before_periods = 2;
constexpr std::uint64_t close_up_after_periods = 10;
constexpr std::size_t most_close_ups = 12;
constexpr std::uint64_t ending_periods = 256;

}  // namespace

void Course::take(const loop::Period& period) {
  curve_.add(period.begin_s, {period.friction_ratio, period.friction_force_N, period.target,
                              period.drive_amplitude_N, period.begin_velocity_m_per_s,
                              period.bias_N, period.begin_distance_m});
  largest_bias_N_ = std::max(largest_bias_N_, std::abs(period.bias_N));
  fastest_m_per_s_ = std::max({fastest_m_per_s_, std::abs(period.begin_velocity_m_per_s),
                               std::abs(period.end_velocity_m_per_s)});
  nearest_m_ = std::min({nearest_m_, period.begin_distance_m, period.end_distance_m});
  farthest_m_ = std::max({farthest_m_, period.begin_distance_m, period.end_distance_m});
  ++periods_in_[static_cast<std::size_t>(period.limit)];
  if (period.open_fraction > 0.0) {
    ++periods_in_[static_cast<std::size_t>(control::Limit::contact_lost)];
  }
}

void VibrationCourse::take(const loop::Period& period) {
  constexpr double degrees = 360.0 / numeric::two_pi;
  curve_.add(
      period.begin_s,
      {std::abs(period.vibration_m_per_s), period.wanted_vibration_m_per_s,
       std::abs(period.current_A), period.frequency_Hz, period.natural_Hz,
       period.drive_amplitude_N == 0.0 ? gap : degrees * std::arg(period.vibration_m_per_s)});
  remember(period);
}

void VibrationCourse::remember(const loop::Period& period) {
  if (transducer_ && period.whole && period.drive_amplitude_N != 0.0) {
    const double voltage_V = transducer_->voltage_V(period.drive_amplitude_N);
    constexpr double kept = 1.0 - 1.0 / operating_periods;
    recent_.periods = kept * recent_.periods + 1.0;
    recent_.frequency_Hz = kept * recent_.frequency_Hz + period.frequency_Hz;
    recent_.voltage_V = kept * recent_.voltage_V + voltage_V;
    recent_.either_voltage_V = kept * recent_.either_voltage_V + std::abs(voltage_V);
    recent_.current_A = kept * recent_.current_A + period.current_A;
  }
}

std::optional<VibrationCourse::OperatingPoint> VibrationCourse::operating_point() const {
  constexpr double least_part = 0.25;
  if (!(std::abs(recent_.voltage_V) > least_part * recent_.either_voltage_V)) {
    return std::nullopt;
  }
  return OperatingPoint{recent_.frequency_Hz / recent_.periods,
                        recent_.current_A / recent_.voltage_V};
}

RunFindings::RunFindings(const configure::Experiment& experiment)
    : scene_(experiment.plant), grid_(scene_) {
  if (const auto& design = experiment.design) {
    step_meter_.emplace(scene_, *design);
    tracking_meter_.emplace(scene_, design->speed_floor_m_per_s());
    if (design->texture) {
      texture_meter_.emplace(scene_);
    }
  }
  if (scene_.demodulates()) {
    vibration_.emplace(scene_.transducer);
  }
  close_ups_.resize(std::min(target_steps_s().size(), most_close_ups));
}

void RunFindings::join(loop::Watch& watch) {
  watch.periods.push_back(&course_);
  if (vibration_) {
    watch.periods.push_back(&*vibration_);
  }
  if (step_meter_) {
    watch.periods.push_back(&*step_meter_);
    watch.periods.push_back(&*tracking_meter_);
    if (texture_meter_) {
      watch.periods.push_back(&*texture_meter_);
    }
  }
  const std::vector<double> steps_s = target_steps_s();
  for (std::size_t i = 0; i < close_ups_.size(); ++i) {
    watch.samples.push_back({close_up_grid(steps_s[i]), &close_ups_[i]});
  }
  watch.samples.push_back({ending_grid(steps_s.back()), &ending_});
}

std::vector<report::StepMetrics> RunFindings::steps() const {
  return step_meter_ ? step_meter_->steps() : std::vector<report::StepMetrics>();
}

report::PauseMetrics RunFindings::pauses() const {
  return step_meter_ ? step_meter_->pauses() : report::PauseMetrics();
}

std::optional<double> RunFindings::largest_tracking_error() const {
  return tracking_meter_ ? tracking_meter_->largest_error() : std::nullopt;
}

/// Those inside the run; in open loop its beginning.
std::vector<double> RunFindings::target_steps_s() const {
  std::vector<double> steps_s{0.0};
  if (scene_.controller) {
    for (const TargetSpan& span : target_spans(scene_)) {
      if (span.step_s > 0.0) {
        steps_s.push_back(span.step_s);
      }
    }
  }
  return steps_s;
}

loop::SampleGrid RunFindings::close_up_grid(double step_s) const {
  // On the grid of carrier periods, so that the drive phase is 0 at the left.
  const std::uint64_t step = grid_.at_or_after(step_s);
  const std::uint64_t first = step - std::min(step, close_up_before_periods);
  return {grid_.begin_s(first),
          std::min(scene_.run.duration_s, grid_.begin_s(step + close_up_after_periods)),
          grid_.period_s() / samples_per_period};
}

/// The last whole carrier periods, within three quarters of the last step's time.
loop::SampleGrid RunFindings::ending_grid(double last_step_s) const {
  const double end_s = scene_.run.duration_s;
  const std::uint64_t settled = grid_.over_at(0.75 * (end_s - last_step_s));
  const std::uint64_t last = grid_.over_at(end_s);
  const std::uint64_t kept = std::min({ending_periods, std::max<std::uint64_t>(1, settled), last});
  return {grid_.begin_s(last - kept), grid_.begin_s(last), grid_.period_s() / samples_per_period};
}

}  // namespace sonoglide::report
