#include "host_sim/report/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "firmware/control/interface/names.hpp"
#include "host_sim/output/number.hpp"

namespace sonoglide::report {

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  return text;
}

AmplitudeUnit amplitude_unit(const scene::Scene& scene) {
  return scene.transducer ? AmplitudeUnit{"V", scene.transducer->voltage_V(1.0)}
                          : AmplitudeUnit{"N", 1.0};
}

std::vector<double> AmplitudeUnit::of(std::vector<double> forces_N) const {
  for (double& force : forces_N) {
    force *= per_N;
  }
  return forces_N;
}

std::string target_figure(const TargetUnit& unit, double part) {
  return unit.is_force() ? figure("{:.4g}", part * unit.size) : figure("{:.3f}", part);
}

std::string error_figure(const TargetUnit& unit, double part) {
  return unit.is_force() ? figure("{:+.3g}", part * unit.size) : figure("{:+.5f}", part);
}

std::string width_figure(const TargetUnit& unit, double part) {
  return unit.is_force() ? figure("{:.3g}", part * unit.size) : figure("{:.5f}", part);
}

std::string held_head(const TargetUnit& unit, const char* name) {
  return unit.is_force() ? fmt::format("{} [{}]", name, unit.name) : name;
}

namespace {

/// Whether the drive stands at an end of its range though the ratio, or force, is beyond its target: what the
/// controller reads or believes is wrong.
bool is_at_wrong_end(const report::StepMetrics& step) {
  if (step.settling_time_s || step.least_friction || !step.limit_seen_by_controller ||
      std::abs(step.steady_error) <= step.ripple) {
    return false;
  }
  switch (step.limit) {
    case control::Limit::actuator:
    case control::Limit::voltage:
    case control::Limit::current:
      return step.steady_error < 0.0;
    case control::Limit::ratio_end:
      return step.steady_error > 0.0;
    default:
      return false;
  }
}

}  // namespace

std::string limit_text(const report::StepMetrics& step) {
  std::string text = control::name(step.limit);
  if (std::isnan(step.steady_error)) {
    return text + ", no carrier period to judge it by";
  }
  if (step.limit == control::Limit::not_settling && step.cause != control::Settling::pending) {
    text += fmt::format(" ({})", control::name(step.cause));
  }
  if (const auto& least = step.least_friction) {
    text += least->below_target
                ? fmt::format(" (past the least friction: {} of vibration give a ratio of {:.3g})",
                              output::quantity(least->vibration_m_per_s, "m/s"), least->ratio)
                : fmt::format(" (no vibration gives a ratio below {:.3g})", least->ratio);
  }
  if (is_at_wrong_end(step)) {
    text +=
        " (by what the controller reads or believes wrongly: the true value is beyond the target)";
  }
  constexpr double little = 0.05;  // of a friction that has been learnt
  if (step.limit == control::Limit::mismatch && step.mismatch &&
      std::abs(std::log(*step.mismatch)) > little) {
    text += fmt::format(" (nominal/true friction {:.3g})", *step.mismatch);
  }
  if (!step.limit_seen_by_controller) {
    text += step.controller_undecided ? ", not yet judged by the controller"
                                      : ", not detected by the controller";
  } else if (step.limit == control::Limit::not_settling && step.settling_time_s) {
    text += ", in the controller's reading alone";
  }
  return text;
}

namespace {

std::string stack_text(const loop::ImageMemory& record) {
  return record.stack_bytes_bound ? fmt::format("{}", *record.stack_bytes_bound)
                                  : "no bound: " + record.stack_unbounded_by;
}

const char* counted(const loop::ImageRecord& record) {
  return record.counts_clocks ? "clocks" : "instructions (not cycles)";
}

nlohmann::ordered_json instructions(const loop::InstructionRange& range) {
  return {{"min", range.min}, {"mean", range.mean}, {"max", range.max}};
}

}  // namespace

output::Table image_table(const loop::ImageRecord& record) {
  output::Table table{"Image on " + record.board, {}, {}};
  const auto row = [&table](const char* name, std::string value) {
    table.rows.push_back({name, std::move(value)});
  };
  if (record.instructions) {
    const loop::InstructionRange& step = record.instructions->step;
    row(record.counts_clocks ? "Clocks of a control step, smallest"
                             : "Instructions of a control step (not cycles), smallest",
        fmt::format("{}", step.min));
    row("Mean", fmt::format("{:.1f}", step.mean));
    row("Largest", fmt::format("{}", step.max));
    row("Mean with the frames of lockstep",
        fmt::format("{:.1f}", record.instructions->answer.mean));
  }
  if (record.workstation) {
    row("Trace hash of the same loop on the workstation",
        fmt::format("{:016x}", record.workstation->trace_hash));
    row("Every drive command the same", record.workstation->same ? "yes" : "NO");
  }
  if (record.memory) {
    row("Flash [B]", fmt::format("{}", record.memory->flash_bytes));
    row("Static RAM [B]", fmt::format("{}", record.memory->ram_bytes));
    row("Deepest stack [B]", stack_text(*record.memory));
  }
  if (record.exchanges_per_second) {
    row("Exchanges per second", fmt::format("{:.0f}", *record.exchanges_per_second));
  }
  return table;
}

nlohmann::ordered_json image_json(const loop::ImageRecord& record) {
  nlohmann::ordered_json json = {
      {"board", record.board},
      {"exchanges_per_second", output::json_number(record.exchanges_per_second)},
      {"trace_hash_workstation", nullptr},
      {"same_as_workstation", nullptr},
      {"instructions_per_step", nullptr},
      {"instructions_per_answer", nullptr},
      {"flash_bytes", nullptr},
      {"ram_bytes", nullptr},
      {"stack_bytes_bound", nullptr}};
  if (record.workstation) {
    json["trace_hash_workstation"] = fmt::format("{:016x}", record.workstation->trace_hash);
    json["same_as_workstation"] = record.workstation->same;
  }
  if (record.instructions) {
    json["instructions_per_step"] = instructions(record.instructions->step);
    json["instructions_per_answer"] = instructions(record.instructions->answer);
  }
  if (record.memory) {
    json["flash_bytes"] = record.memory->flash_bytes;
    json["ram_bytes"] = record.memory->ram_bytes;
    if (record.memory->stack_bytes_bound) {
      json["stack_bytes_bound"] = *record.memory->stack_bytes_bound;
    } else {
      json["stack_unbounded_by"] = record.memory->stack_unbounded_by;
    }
  }
  return json;
}

std::string image_lines(const loop::ImageRecord& record) {
  std::string text = "image on " + record.board;
  if (record.memory) {
    text += fmt::format(": {} B flash, {} B static RAM, deepest stack [B] {}",
                        record.memory->flash_bytes, record.memory->ram_bytes,
                        stack_text(*record.memory));
  }
  text += '\n';
  if (record.workstation) {
    text += record.workstation->same
                ? "every drive command is the workstation's, bit for bit\n"
                : fmt::format("NOT THE SAME as on the workstation, whose trace hash is {:016x}\n",
                              record.workstation->trace_hash);
  }
  if (record.instructions && record.exchanges_per_second) {
    text +=
        fmt::format("a step takes {} to {} {}; {:.0f} exchanges/s\n", record.instructions->step.min,
                    record.instructions->step.max, counted(record), *record.exchanges_per_second);
  }
  return text;
}

}  // namespace sonoglide::report
