#include "tests/random_loops/loops/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "firmware/control/interface/names.hpp"

namespace sonoglide::random_loops {
namespace {

struct Class {
  std::string of;
  std::string name;
  std::function<bool(const RandomLoop&)> holds;
};

std::vector<Class> classes() {
  std::vector<Class> all = {{"all", "all", [](const RandomLoop&) { return true; }}};
  for (std::size_t i = 0; i < mode_names.size(); ++i) {
    all.push_back({"mode", std::string(mode_names[i]),
                   [i](const RandomLoop& loop) { return loop.mode == static_cast<Mode>(i); }});
  }
  for (const double within : {0.0052, 0.02, 0.064}) {
    all.push_back({"mode beside a multiple", fmt::format("within {}", within),
                   [within](const RandomLoop& loop) { return beside_multiple(loop) < within; }});
  }
  all.push_back({"mode over carrier", "below 0.064",
                 [](const RandomLoop& loop) { return loop.mode_per_carrier < 0.064; }});
  all.push_back(
      {"damping", "none", [](const RandomLoop& loop) { return loop.damping_ratio == 0.0; }});
  all.push_back({"damping", "below 0.01", [](const RandomLoop& loop) {
                   return loop.damping_ratio > 0.0 && loop.damping_ratio < 0.01;
                 }});
  all.push_back({"damping", "from 0.01 on",
                 [](const RandomLoop& loop) { return loop.damping_ratio >= 0.01; }});
  for (const char* law :
       {"dahl", "coulomb", "lugre", "iwan", "stribeck", "transverse_coulomb", "normal_coulomb"}) {
    all.push_back({"law", law, [law](const RandomLoop& loop) { return loop.law == law; }});
  }
  all.push_back({"sensor", "ideal", [](const RandomLoop& loop) { return loop.sensor.ideal(); }});
  all.push_back({"sensor", "8 or 9 bits",
                 [](const RandomLoop& loop) { return loop.sensor.adc_bits.value_or(32) <= 9; }});
  all.push_back({"sensor", "10 to 16 bits",
                 [](const RandomLoop& loop) { return loop.sensor.adc_bits.value_or(0) >= 10; }});
  all.push_back(
      {"sensor", "noise", [](const RandomLoop& loop) { return loop.sensor.force_noise_N > 0.0; }});
  all.push_back({"sensor", "low-pass", [](const RandomLoop& loop) {
                   return loop.sensor.force_bandwidth_Hz.has_value();
                 }});
  all.push_back(
      {"sensor", "delay", [](const RandomLoop& loop) { return loop.sensor.delay_periods > 0; }});
  for (const char* arithmetic : {"float64", "float32", "q31", "q15"}) {
    all.push_back({"arithmetic", arithmetic,
                   [arithmetic](const RandomLoop& loop) { return loop.arithmetic == arithmetic; }});
  }
  for (std::size_t i = 0; i < cause_names.size(); ++i) {
    all.push_back({"cause", std::string(cause_names[i]), [i](const RandomLoop& loop) {
                     return cause_of(loop) == static_cast<Cause>(i);
                   }});
  }
  all.push_back({"friction level", "trusted",
                 [](const RandomLoop& loop) { return loop.calibration_s == 0.0; }});
  all.push_back({"friction level", "learnt",
                 [](const RandomLoop& loop) { return loop.calibration_s > 0.0; }});
  return all;
}

/// Of steps that never settle; the rest of the limits is rare.
constexpr std::array<control::Limit, 3> told_limits = {
    control::Limit::not_settling, control::Limit::mismatch, control::Limit::ratio_end};

struct Counts {
  std::size_t drawn = 0;
  std::size_t refused = 0;
  std::size_t failed = 0;
  std::size_t steps = 0;
  std::array<std::size_t, verdicts> of_verdict{};
  std::size_t at_end = 0;
  std::size_t out_of_reach = 0;
  std::array<std::size_t, told_limits.size()> of_limit{};
  std::size_t faults = 0;
  std::size_t named_settled = 0;
  std::vector<double> ripples;
};

bool out_of_reach(const StepOutcome& step, Verdict verdict) {
  return verdict == Verdict::never_named &&
         (step.metrics.limit == control::Limit::actuator || step.no_vibration);
}

/// Why a step never settles that the drive could reach.
void count_name(const StepOutcome& step, Verdict verdict, Counts& counts) {
  if (verdict != Verdict::never_named || out_of_reach(step, verdict)) {
    return;
  }
  if (!step.fault.empty()) {
    ++counts.faults;
    return;
  }
  for (std::size_t i = 0; i < told_limits.size(); ++i) {
    counts.of_limit[i] += step.metrics.limit == told_limits[i] ? 1 : 0;
  }
}

enum class Judged { ratio, velocity };

void count(const Outcome& outcome, Judged judged, Counts& counts) {
  ++counts.drawn;
  counts.refused += outcome.refused.empty() ? 0 : 1;
  counts.failed += outcome.failed.empty() ? 0 : 1;
  for (const StepOutcome& step : outcome.steps) {
    ++counts.steps;
    const bool ratio = judged == Judged::ratio;
    const Verdict verdict = ratio ? step.verdict : step.velocity_verdict;
    ++counts.of_verdict[static_cast<std::size_t>(verdict)];
    counts.at_end += ratio && step.at_end ? 1 : 0;
    counts.out_of_reach += out_of_reach(step, verdict) ? 1 : 0;
    count_name(step, verdict, counts);
    counts.named_settled += ratio && step.settled() && step.named() ? 1 : 0;
    counts.ripples.push_back(step.metrics.ripple);
  }
}

/// Of the first so many outcomes.
Counts counts_of(const std::vector<Outcome>& all, std::size_t loops, bool wrong, Judged judged,
                 const Class& each) {
  Counts counts;
  for (std::size_t i = 0; i < std::min(loops, all.size()); ++i) {
    if (all[i].loop.model_error.has_value() == wrong && each.holds(all[i].loop)) {
      count(all[i], judged, counts);
    }
  }
  return counts;
}

/// Of sorted values, the one that this part of them does not exceed.
double quantile(const std::vector<double>& sorted, double part) {
  const double rank = std::ceil(part * static_cast<double>(sorted.size()));
  return sorted[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

std::string quantiles(std::vector<double> values) {
  if (values.empty()) {
    return "nan,nan,nan";
  }
  std::sort(values.begin(), values.end());
  return fmt::format("{:.3g},{:.3g},{:.3g}", quantile(values, 0.5), quantile(values, 0.9),
                     quantile(values, 0.99));
}

std::string row(std::size_t loops, const char* model, Judged judged, const Class& each,
                const Counts& counts) {
  return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", loops,
                     model, judged == Judged::ratio ? "ratio" : "velocity", each.of, each.name,
                     counts.drawn, counts.refused, counts.failed, counts.steps,
                     counts.of_verdict[0], counts.of_verdict[1], counts.at_end,
                     counts.of_verdict[2], counts.out_of_reach, counts.of_limit[0],
                     counts.of_limit[1], counts.of_limit[2], counts.faults, counts.of_verdict[3],
                     counts.named_settled, quantiles(counts.ripples));
}

std::vector<Judged> judgements(const std::vector<Outcome>& all) {
  const bool observed = std::any_of(all.begin(), all.end(), [](const Outcome& outcome) {
    return !outcome.steps.empty() && outcome.steps.front().metrics.vibration;
  });
  return observed ? std::vector<Judged>{Judged::ratio, Judged::velocity}
                  : std::vector<Judged>{Judged::ratio};
}

std::string optional_number(double value) {
  return value == 0.0 ? "" : fmt::format("{:.6g}", value);
}

std::string loop_cells(const RandomLoop& loop) {
  const ModelErrorNumbers error = loop.model_error.value_or(ModelErrorNumbers{});
  const SensorNumbers& sensor = loop.sensor;
  return fmt::format(
      "{},{},{},{:.6g},{:.6g},{:.6g},{:.3g},{:.6g},{:.3g},{:.3g},{:.3g},{},{},{},{},{:.3g},{:.3g},{"
      ":.3g},"
      "{:.3g}",
      loop.law, loop.arithmetic, mode_names[static_cast<std::size_t>(loop.mode)], loop.mass_kg,
      loop.frequency_Hz, loop.mode_per_carrier, loop.damping_ratio, loop.sliding_velocity_m_per_s,
      loop.full_velocity_ratio, loop.full_dahl_number, loop.friction_ringing,
      sensor.adc_bits.value_or(0),
      optional_number(sensor.force_noise_N / (loop.coefficient * loop.normal_force_N)),
      optional_number(sensor.force_bandwidth_Hz.value_or(0.0)), sensor.delay_periods,
      loop.calibration_s, error.stiffness, error.coefficient, error.contact_stiffness);
}

constexpr const char* list_header =
    "index,step,law,arithmetic,mode,mass_kg,frequency_Hz,mode_per_carrier,damping_ratio,"
    "sliding_velocity_m_per_s,full_velocity_ratio,full_dahl_number,friction_ringing,adc_bits,noise_"
    "per_friction,"
    "force_bandwidth_Hz,delay_periods,calibration_s,error_stiffness,error_coefficient,"
    "error_contact_stiffness,target,limit,fault,verdict,velocity_verdict,settling_time_s,steady_"
    "error,ripple,drive_"
    "part\n";

std::string list(const std::vector<Outcome>& all,
                 const std::function<bool(const StepOutcome&)>& wanted) {
  std::string text = list_header;
  for (const Outcome& outcome : all) {
    for (std::size_t i = 0; i < outcome.steps.size(); ++i) {
      const StepOutcome& step = outcome.steps[i];
      if (wanted(step)) {
        const report::StepMetrics& metrics = step.metrics;
        text += fmt::format(
            "{},{},{},{:.6g},{},{},{},{},{:.4g},{:.4g},{:.4g},{:.4g}\n", outcome.loop.index, i,
            loop_cells(outcome.loop), metrics.target, control::name(metrics.limit),
            step.fault.empty() ? "none" : step.fault,
            verdict_names[static_cast<std::size_t>(step.verdict)],
            metrics.vibration ? verdict_names[static_cast<std::size_t>(step.velocity_verdict)] : "",
            metrics.settling_time_s.value_or(NAN), metrics.steady_error, metrics.ripple,
            metrics.drive_amplitude_N / outcome.loop.max_force_amplitude_N);
      }
    }
  }
  return text;
}

}  // namespace

std::string table_csv(const std::vector<Outcome>& all, const std::vector<std::uint32_t>& counts) {
  std::string text =
      "loops,model,judged_by,class_of,class,drawn,refused,failed,steps,prompt,late,at_end,never_"
      "named,out_of_reach,not_settling,mismatch,ratio_end,fault,"
      "never_unnamed,named_settled,ripple_p50,ripple_p90,ripple_p99\n";
  for (const std::uint32_t loops : counts) {
    for (const Judged judged : judgements(all)) {
      for (const bool wrong : {false, true}) {
        for (const Class& each : classes()) {
          text += row(loops, wrong ? "wrong" : "exact", judged, each,
                      counts_of(all, loops, wrong, judged, each));
        }
      }
    }
  }
  return text;
}

std::string list_csv(const std::vector<Outcome>& all, std::optional<Verdict> verdict) {
  return list(all,
              [verdict](const StepOutcome& step) { return !verdict || step.verdict == *verdict; });
}

std::string named_settled_csv(const std::vector<Outcome>& all) {
  return list(all, [](const StepOutcome& step) { return step.settled() && step.named(); });
}

std::string refusals_text(const std::vector<Outcome>& all) {
  std::string text;
  for (const Outcome& outcome : all) {
    if (!outcome.refused.empty() || !outcome.failed.empty()) {
      text += fmt::format("{}: {}{}\n", outcome.loop.index, outcome.refused, outcome.failed);
    }
  }
  return text;
}

}  // namespace sonoglide::random_loops
