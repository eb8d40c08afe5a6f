#include "tests/random_loops/loops/outcome.hpp"

#include <tbb/parallel_for.h>

#include <limits>
#include <optional>
#include <stdexcept>

#include "firmware/control/interface/names.hpp"
#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/loop/plant/failure.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/loop/steady/requirement.hpp"
#include "host_sim/report/step_metrics.hpp"

namespace sonoglide::random_loops {
namespace {

/// The last fault that came before a time.
std::string fault_at(const loop::ControlRecord& record, double time_s) {
  std::string name;
  for (const loop::FaultEvent& event : record.faults) {
    if (event.time_s <= time_s) {
      name = control::name(event.fault);
    }
  }
  return name;
}

Verdict verdict(const StepOutcome& step, const std::optional<double>& settling_time_s) {
  if (settling_time_s) {
    return *settling_time_s <= prompt_s ? Verdict::prompt : Verdict::late;
  }
  return step.named() ? Verdict::never_named : Verdict::never_unnamed;
}

/// By the closed form of the law, with the true contact; the band is not reached either.
bool no_vibration_gives(const scene::Scene& scene, double target) {
  const double sliding_m_per_s = scene.sliding.fastest_m_per_s();
  return target < 1.0 &&
         steady::closed_form_vibration(scene, sliding_m_per_s, target).friction_ratio >
             target + scene.run.settling_band;
}

void run_loop(const experiment::Experiment& experiment, Outcome& outcome) {
  const scene::Scene& scene = experiment.plant;
  report::StepMeter meter(scene, *experiment.design);
  loop::Watch watch;
  watch.periods.push_back(&meter);
  const loop::RunResult result = loop::run(experiment, watch);
  const std::vector<report::StepMetrics> steps = meter.steps();
  const std::vector<report::TargetSpan> spans = report::target_spans(scene);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    StepOutcome step{steps[i], fault_at(*result.control, spans[i].end_s)};
    step.verdict = verdict(step, steps[i].settling_time_s);
    if (steps[i].vibration) {
      step.velocity_verdict = verdict(step, steps[i].vibration->settling_time_s);
    }
    step.at_end =
        step.settled() && spans[i].begin_s + *steps[i].settling_time_s > spans[i].quarter_s;
    step.no_vibration = !step.settled() && no_vibration_gives(scene, steps[i].target);
    outcome.steps.push_back(step);
  }
}

/// How a loop with all means comes to know its friction, best first: it calibrates, or where there is no time
/// for it learns while it drives, or else trusts.
std::vector<std::vector<std::string>> friction_sources(Vibration vibration) {
  if (vibration != Vibration::all_means) {
    return {{}};
  }
  return {{"controller.friction=\"calibrated\""},
          {"controller.friction=\"tracked\"",
           "controller.calibration_s=", "controller.vibration=", "drive.bias_limit_N="},
          {}};
}

/// @throws scene_file::SceneError  the scene is refused
experiment::Experiment read(const RandomLoop& loop, Vibration vibration,
                            const std::vector<std::string>& overrides) {
  const auto sources = friction_sources(vibration);
  for (const std::vector<std::string>& source : sources) {
    std::vector<std::string> all = overrides;
    all.insert(all.end(), source.begin(), source.end());
    try {
      return experiment::read_text(scene_text(loop, vibration), "random.toml", all);
    } catch (const scene_file::SceneError&) {
      if (&source == &sources.back()) {
        throw;
      }
    }
  }
  throw std::logic_error("a loop has a source of its friction");
}

}  // namespace

bool StepOutcome::named() const {
  return metrics.limit != control::Limit::none || !fault.empty();
}

Outcome outcome(std::uint32_t seed, std::uint32_t index, Vibration vibration,
                const std::vector<std::string>& overrides) {
  Outcome outcome;
  outcome.loop = random_loop(seed, index);
  try {
    const experiment::Experiment experiment = read(outcome.loop, vibration, overrides);
    if (vibration == Vibration::sensorless || vibration == Vibration::sensorless_biased) {
      outcome.loop.calibration_s =
          *experiment.plant.controller->calibration_s;  // absent: by default
    }
    run_loop(experiment, outcome);
  } catch (const scene_file::SceneError& error) {
    outcome.refused = error.what();
    outcome.refused_key = error.key();
  } catch (const loop::ComputationError& error) {
    outcome.failed = error.what();
  }
  return outcome;
}

std::vector<Outcome> outcomes(std::uint32_t seed, std::uint32_t count, Vibration vibration,
                              const std::vector<std::string>& overrides) {
  std::vector<Outcome> all(count);
  tbb::parallel_for(std::uint32_t{0}, count, [&](std::uint32_t index) {
    all[index] = outcome(seed, index, vibration, overrides);
  });
  return all;
}

}  // namespace sonoglide::random_loops
