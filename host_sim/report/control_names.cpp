#include "host_sim/report/control_names.hpp"

namespace sonoglide::report {

std::string limit_name(control::Limit limit) {
  switch (limit) {
    case control::Limit::actuator:
      return "actuator";
    case control::Limit::slew:
      return "slew";
    case control::Limit::speed_floor:
      return "speed_floor";
    case control::Limit::none:
      break;
  }
  return "none";
}

std::string fault_name(control::Fault fault) {
  switch (fault) {
    case control::Fault::measurement_not_finite:
      return "measurement_not_finite";
    case control::Fault::measurement_missing:
      return "measurement_missing";
    case control::Fault::measurement_saturated:
      return "measurement_saturated";
    case control::Fault::measurement_stuck:
      return "measurement_stuck";
    case control::Fault::friction_not_learnt:
      return "friction_not_learnt";
    case control::Fault::none:
      break;
  }
  return "none";
}

}  // namespace sonoglide::report
