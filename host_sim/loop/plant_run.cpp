#include "host_sim/loop/plant_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "host_sim/loop/computation_error.hpp"
#include "host_sim/loop/time_rounding.hpp"

namespace sonoglide::loop {
namespace {

constexpr double two_pi = 6.28318530717958647693;
/// Without a drive the run is reported in this many pieces.
constexpr double undriven_pieces = 1000.0;
constexpr double samples_per_period = 64.0;
constexpr double close_up_before_periods = 2.0;
constexpr double close_up_after_periods = 10.0;
constexpr std::size_t most_close_ups = 12;
constexpr double ending_periods = 256.0;

double piece_duration_s(const scene::Scene& scene) {
  return scene.drive ? 1.0 / scene.drive->frequency_Hz : scene.run.duration_s / undriven_pieces;
}

const char* reason(plant::Error error) {
  switch (error) {
    case plant::Error::friction_bound_broken:
      return "|F| > Fc, the step is too long for the contact stiffness";
    case plant::Error::too_many_steps:
      return "more than a million steps in one carrier period";
    case plant::Error::not_finite:
    case plant::Error::none:
      break;
  }
  return "the state is no longer finite";
}

}  // namespace

PlantRun::PlantRun(const scene::Scene& scene, RunResult& result)
    : scene_(scene),
      result_(result),
      plant_(make_plant_port(scene)),
      sliding_(scene.sliding),
      period_s_(piece_duration_s(scene)),
      cuts_s_(sliding_.cuts_s()) {
  cuts_s_.push_back(scene.run.window_start_s);
  std::sort(cuts_s_.begin(), cuts_s_.end());
  request_recordings();
}

EnergyBalance PlantRun::advance(double begin_s, double end_s, double amplitude_N) {
  const double rounding_s = time_rounding * period_s_;
  EnergyBalance total;
  double from_s = begin_s;
  for (auto cut = std::upper_bound(cuts_s_.begin(), cuts_s_.end(), begin_s + rounding_s);
       cut != cuts_s_.end() && *cut < end_s - rounding_s; ++cut) {
    if (*cut > from_s + rounding_s) {
      stretch(begin_s, from_s, *cut, amplitude_N, total);
      from_s = *cut;
    }
  }
  stretch(begin_s, from_s, end_s, amplitude_N, total);
  result_.whole.append(total);
  return total;
}

void PlantRun::finish() {
  result_.final_state = plant_->state();
  result_.final_time_s = scene_.run.duration_s;
  result_.solver_steps = plant_->cost().steps;
  result_.solver_events = plant_->cost().events;
}

void PlantRun::request_recordings() {
  if (!scene_.run.record.empty()) {
    recorder_.want(0.0, scene_.run.duration_s, scene_.run.record_interval_s, result_.trace);
  }
  const std::vector<double> steps_s = target_steps_s();
  result_.close_ups.resize(std::min(steps_s.size(), most_close_ups));
  for (std::size_t i = 0; i < result_.close_ups.size(); ++i) {
    request_close_up(steps_s[i], result_.close_ups[i]);
  }
  request_ending(steps_s.back());
}

/// Those inside the run; in open loop its beginning.
std::vector<double> PlantRun::target_steps_s() const {
  std::vector<double> steps_s{0.0};
  if (scene_.controller) {
    for (const scene::TargetStep& step : scene_.controller->target_friction_ratio) {
      if (step.time_s > 0.0 && step.time_s < scene_.run.duration_s) {
        steps_s.push_back(step.time_s);
      }
    }
  }
  return steps_s;
}

void PlantRun::request_close_up(double step_s, Recording& into) {
  // On the grid of carrier periods, so that the drive phase is 0 at the left.
  const double step_period = std::ceil(step_s / period_s_ - time_rounding);
  const double begin_s = std::max(0.0, step_period - close_up_before_periods) * period_s_;
  const double end_s = (step_period + close_up_after_periods) * period_s_;
  recorder_.want(begin_s, std::min(scene_.run.duration_s, end_s), period_s_ / samples_per_period,
                 into);
}

/// The last whole carrier periods, within three quarters of the last step's time.
void PlantRun::request_ending(double last_step_s) {
  const double end_s = scene_.run.duration_s;
  const double settled_s = last_step_s + 0.25 * (end_s - last_step_s);
  const double settled = std::floor((end_s - settled_s) / period_s_ + time_rounding);
  const double kept = std::min(ending_periods, std::max(1.0, settled));
  const double last = std::floor(end_s / period_s_ + time_rounding);
  recorder_.want(std::max(0.0, last - kept) * period_s_, last * period_s_,
                 period_s_ / samples_per_period, result_.ending);
}

void PlantRun::stretch(double period_begin_s, double begin_s, double end_s, double amplitude_N,
                       EnergyBalance& total) {
  const double rate = scene_.drive ? two_pi * scene_.drive->frequency_Hz : 0.0;
  const double first = sliding_.velocity_m_per_s(begin_s);
  const double last = sliding_.velocity_m_per_s(end_s);
  const double duration_s = end_s - begin_s;
  const Stretch stretch{duration_s, rate * (begin_s - period_begin_s), rate, amplitude_N,
                        first,      (last - first) / duration_s};
  const double rounding_s = time_rounding * period_s_;
  const bool in_window = begin_s >= scene_.run.window_start_s - rounding_s;
  const bool ends_run = end_s >= scene_.run.duration_s - rounding_s;
  const Watch watch{in_window, recorder_.plan(begin_s, end_s, ends_run)};
  std::vector<PlantState> seen;
  EnergyBalance energy;
  const plant::Outcome<double> outcome = plant_->advance(stretch, watch, energy, seen);
  if (outcome.error != plant::Error::none) {
    fail(outcome.error, begin_s + outcome.offset);
  }
  recorder_.take(begin_s, stretch, seen);
  total.append(energy);
  if (in_window) {
    result_.window.append(energy);
  }
}

void PlantRun::fail(plant::Error error, double time_s) const {
  const PlantState state = plant_->state();
  throw ComputationError(fmt::format(
      "solver: at {:.6g} s, displacement {:.6g} m, velocity {:.6g} m/s, friction force {:.6g} N: "
      "{}",
      time_s, state.displacement_m, state.velocity_m_per_s, state.friction_force_N, reason(error)));
}

}  // namespace sonoglide::loop
