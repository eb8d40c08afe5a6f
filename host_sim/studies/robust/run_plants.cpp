#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <utility>

#include "firmware/control/interface/names.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/report/words.hpp"
#include "host_sim/runs/closed_loops.hpp"
#include "host_sim/runs/run_many.hpp"
#include "host_sim/studies/robust/study.hpp"

namespace sonoglide::robust {
namespace {

/// NaN is left out.
void raise(double& largest, double value) {
  largest = std::fmax(largest, value);
}

template <class Name>
std::vector<std::string> names(std::uint64_t bits, const Name& name) {
  std::vector<std::string> all;
  for (unsigned bit = 0; bits >> bit != 0; ++bit) {
    if (((bits >> bit) & 1U) != 0) {
      all.push_back(name(bit));
    }
  }
  return all;
}

}  // namespace

bool PlantRow::plausible() const {
  constexpr auto last_fault = static_cast<unsigned>(control::Fault::velocity_stuck);
  return limits >> control::limit_count == 0 && faults >> (last_fault + 1) == 0;
}

double PlantRow::badness() const {
  constexpr double of_failed = 10.0;  // a ratio is 0 to 2 about its target
  constexpr double of_not_computed = 100.0;
  if (!ok()) {
    return of_not_computed;
  }
  return (failed() ? of_failed : 0.0) + (std::isnan(deviation) ? 0.0 : deviation);
}

PlantRow row_of(const std::vector<report::StepMetrics>& steps, const loop::ControlRecord& control) {
  PlantRow row;
  for (const report::StepMetrics& step : steps) {
    row.unsettled += step.settling_time_s ? 0 : 1;
    raise(row.settling_time_s, step.settling_time_s.value_or(PlantRow::undefined));
    raise(row.overshoot, step.overshoot);
    raise(row.steady_error, std::abs(step.steady_error));
    raise(row.ripple, step.ripple);
    raise(row.deviation, std::abs(step.steady_error) + step.ripple);
    if (step.limit != control::Limit::none) {
      row.limits |= std::uint64_t{1} << static_cast<unsigned>(step.limit);
    }
  }
  if (row.unsettled > 0) {
    row.settling_time_s = PlantRow::undefined;
  }
  for (const loop::FaultEvent& event : control.faults) {
    row.faults |= std::uint64_t{1} << static_cast<unsigned>(event.fault);
  }
  row.trace_hash = control.trace_hash;
  return row;
}

PlantRow failed_row(const std::string& reason) {
  PlantRow row;
  row.status = report::one_line(reason);
  return row;
}

std::vector<std::string> limit_names(const PlantRow& row) {
  return names(row.limits,
               [](unsigned bit) { return control::name(static_cast<control::Limit>(bit)); });
}

std::vector<std::string> fault_names(const PlantRow& row) {
  return names(row.faults,
               [](unsigned bit) { return control::name(static_cast<control::Fault>(bit)); });
}

namespace {

PlantRow run_plant(const scene::Scene& plant, const configure::ControlDesign& design) {
  report::StepMeter meter(plant, design);
  loop::Watch watch;
  watch.periods.push_back(&meter);
  watch.energies = false;
  try {
    const loop::RunResult result = loop::run(plant, design, watch);
    return row_of(meter.steps(), *result.control);
  } catch (const loop::ComputationError& error) {
    return failed_row(error.what());
  }
}

/// @return what the lanes give up
runs::Places run_in_lanes(const std::vector<scene::Scene>& plants, const runs::Places& places,
                          const configure::ControlDesign& design, const TakeRows& take) {
  std::vector<report::StepMeter> meters;
  meters.reserve(places.size());
  std::vector<runs::ClosedLoop> loops;
  for (const std::size_t place : places) {
    loops.push_back({plants[place], design, meters.emplace_back(plants[place], design)});
  }
  const std::vector<runs::LoopRun> found = runs::run_closed_loops(loops);
  std::vector<Record> rows;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (found[i].status == batch::RunStatus::solved) {
      rows.push_back({places[i], row_of(meters[i].steps(), found[i].control)});
    }
  }
  take(std::move(rows));
  return runs::given_up(places, found);
}

}  // namespace

void run_plants(const std::vector<scene::Scene>& plants, const configure::ControlDesign& design,
                const TakeRows& take) {
  runs::Places all(plants.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const runs::Calls calls = runs::divide(all, [&](std::size_t place) {
    return runs::runs_in_lanes(plants[place]) ? std::optional(0) : std::nullopt;
  });
  runs::run_many(
      calls, [&](const runs::Places& places) { return run_in_lanes(plants, places, design, take); },
      [&](std::size_t place) {
        take({{place, run_plant(plants[place], design)}});
      });
}

std::vector<PlantRow> run_plants(const std::vector<scene::Scene>& plants,
                                 const configure::ControlDesign& design) {
  std::vector<PlantRow> rows(plants.size());
  run_plants(plants, design, [&rows](std::vector<Record> found) {
    for (Record& record : found) {
      rows[record.point] = std::move(record.row);
    }
  });
  return rows;
}

}  // namespace sonoglide::robust
