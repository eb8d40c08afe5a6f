#include "host_sim/report/control_names.hpp"

#include <fmt/format.h>

#include "firmware/control/names.hpp"

namespace sonoglide::report {

std::string limit_name(control::Limit limit) {
  return control::name(limit);
}

std::string fault_name(control::Fault fault) {
  return control::name(fault);
}

std::string settling_name(control::Settling settling) {
  return control::name(settling);
}

std::string limit_text(const report::StepMetrics& step) {
  std::string text = limit_name(step.limit);
  if (step.limit == control::Limit::not_settling && step.cause != control::Settling::pending) {
    text += fmt::format(" ({})", settling_name(step.cause));
  }
  if (step.limit == control::Limit::mismatch && step.mismatch) {
    text += fmt::format(" (believed/true friction {:.3g})", *step.mismatch);
  }
  if (!step.limit_seen_by_controller) {
    text += ", unseen by the controller";
  }
  return text;
}

}  // namespace sonoglide::report
