#include "host_sim/studies/robust/study.hpp"

#include <cmath>

#include "host_sim/report/words.hpp"

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
               [](unsigned bit) { return report::limit_name(static_cast<control::Limit>(bit)); });
}

std::vector<std::string> fault_names(const PlantRow& row) {
  return names(row.faults,
               [](unsigned bit) { return report::fault_name(static_cast<control::Fault>(bit)); });
}

}  // namespace sonoglide::robust
