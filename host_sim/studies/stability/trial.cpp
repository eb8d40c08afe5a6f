#include "host_sim/studies/stability/trial.hpp"

namespace sonoglide::stability {

Verdict judge(const TrialResult& result, double error, double allowed_error, double bound) {
  if (!result.supported) {
    return Verdict::unsupported;
  }
  switch (result.error) {
    case plant::Error::none:
      break;
    case plant::Error::not_finite:
      return Verdict::declined_not_finite;
    case plant::Error::friction_bound_broken:
      return Verdict::declined_friction_bound;
    case plant::Error::step_too_long:
      return Verdict::declined_step_too_long;
    case plant::Error::too_many_steps:
      return Verdict::declined_too_many_steps;
  }
  if (!result.finite) {
    return Verdict::silent_not_finite;
  }
  if (!(result.largest_friction <= bound)) {
    return Verdict::silent_friction_bound;
  }
  return error <= allowed_error ? Verdict::good : Verdict::wrong;
}

std::array<std::string_view, verdict_count> verdict_names(std::string_view good,
                                                          std::string_view wrong) {
  return {good,
          wrong,
          "silent_friction_bound",
          "silent_not_finite",
          "declined_friction_bound",
          "declined_step_too_long",
          "declined_not_finite",
          "declined_too_many_steps",
          "unsupported"};
}

}  // namespace sonoglide::stability
