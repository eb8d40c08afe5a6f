#include <cmath>
#include <optional>

#include "firmware/control/interface/drive_command.hpp"
#include "host_sim/loop/plant/sliding_profile.hpp"
#include "host_sim/loop/steady/requirement.hpp"
#include "host_sim/report/run_notes.hpp"
#include "host_sim/report/self_excitation.hpp"
#include "host_sim/report/step_metrics.hpp"
#include "host_sim/scene/friction_laws.hpp"

namespace sonoglide::report {

void StepMeter::name_unseen_limit(const TargetSpan& span, const Tally& tally,
                                  StepMetrics& metrics) const {
  const bool read_settled = 2 * tally.settled_periods > tally.steady_periods;
  const bool off = std::abs(metrics.steady_error) > band_;
  const bool mismatch = !unit_.is_force() && (read_settled || holds_blindly(span, tally)) && off;
  metrics.limit = mismatch ? control::Limit::mismatch : control::Limit::not_settling;
  metrics.limit_seen_by_controller = false;
  metrics.controller_undecided = senses_force_ && !read_settled;
  if (!mismatch) {
    metrics.cause = true_cause(span, tally, off);
  }
}

void StepMeter::name_self_excitation(const TargetSpan& span, StepMetrics& metrics) const {
  const bool other_cause = metrics.limit != control::Limit::not_settling &&
                           metrics.limit != control::Limit::mismatch &&
                           metrics.limit != control::Limit::ratio_end;
  if (!other_cause && may_excite_itself_ &&
      excites_itself(*may_excite_itself_, span.quarter_s, metrics.drive_amplitude_N)) {
    metrics.limit = control::Limit::self_excited;
    metrics.cause = control::Settling::pending;
    metrics.limit_seen_by_controller = false;
    metrics.controller_undecided = false;
  }
}

std::optional<LeastFriction> StepMeter::least_friction(const TargetSpan& span,
                                                       const StepMetrics& metrics) const {
  const scene::Scene& scene = *has_least_friction_;
  const double sliding_m_per_s =
      std::abs(loop::SlidingProfile(scene.sliding).velocity_m_per_s(span.quarter_s));
  if (!(sliding_m_per_s > 0.0)) {
    return std::nullopt;
  }
  // From target and band, which are over the friction limit if they are of a force, to ratios.
  const double to_ratio =
      unit_.is_force() ? unit_.size / scene::undriven_friction_N(scene.friction.law, scene.friction,
                                                                 sliding_m_per_s)
                       : 1.0;
  const double target = span.target * to_ratio;
  if (!(target < 1.0)) {
    return std::nullopt;
  }
  const steady::RequiredVibration needed =
      steady::closed_form_vibration(scene, sliding_m_per_s, target);
  const double full_m_per_s = scene.max_drive_force_N() / steady::force_N(scene, 1.0);
  const double mean_m_per_s = metrics.vibration
                                  ? metrics.vibration->velocity_m_per_s
                                  : metrics.drive_amplitude_N / steady::force_N(scene, 1.0);
  constexpr double clearly = 1.05;
  const bool below_target = needed.friction_ratio <= target + band_ * to_ratio;
  const bool full = metrics.limit == control::Limit::actuator ||
                    metrics.limit == control::Limit::voltage ||
                    metrics.limit == control::Limit::current;
  const bool passed = full && mean_m_per_s > clearly * needed.velocity_m_per_s;
  if (needed.velocity_m_per_s > full_m_per_s || (below_target && !passed)) {
    return std::nullopt;
  }
  return LeastFriction{needed.friction_ratio, needed.velocity_m_per_s, below_target};
}

void StepMeter::name_least_friction(const TargetSpan& span, StepMetrics& metrics) const {
  const bool other_cause = metrics.limit == control::Limit::none ||
                           metrics.limit == control::Limit::self_excited ||
                           !(metrics.steady_error > band_);
  if (other_cause || !has_least_friction_) {
    return;
  }
  metrics.least_friction = least_friction(span, metrics);
  if (metrics.least_friction && (metrics.limit == control::Limit::not_settling ||
                                 metrics.limit == control::Limit::mismatch)) {
    metrics.limit = resonant_ ? control::Limit::voltage : control::Limit::actuator;
    metrics.cause = control::Settling::pending;
    metrics.limit_seen_by_controller = false;
    metrics.controller_undecided = false;
  }
}

void StepMeter::name_passed_bound(const Tally& tally, StepMetrics& metrics) const {
  const bool above =
      largest_current_A_ && tally.current_A > told_current_excess * *largest_current_A_;
  if (!tally.open && !(above && metrics.limit == control::Limit::none)) {
    return;
  }
  metrics.limit = tally.open ? control::Limit::contact_lost : control::Limit::current;
  metrics.least_friction.reset();
  metrics.cause = control::Settling::pending;
  metrics.limit_seen_by_controller = false;
  metrics.controller_undecided = false;
}

control::Settling StepMeter::true_cause(const TargetSpan& span, const Tally& tally,
                                        bool off) const {
  const bool above = tally.highest > span.target + band_;
  const bool below = tally.lowest < span.target - band_;
  if (above && below) {
    return control::Settling::ringing;
  }
  return off ? control::Settling::offset : control::Settling::pending;
}

}  // namespace sonoglide::report
