#include "host_sim/studies/work_precision/composed.hpp"

namespace sonoglide::work_precision {

std::string status_of(plant::Error error) {
  switch (error) {
    case plant::Error::friction_bound_broken:
      return "friction bound broken";
    case plant::Error::too_many_steps:
      return "too many steps in a period";
    case plant::Error::not_finite:
      return "state not finite";
    case plant::Error::step_too_long:
      return "step too long";
    case plant::Error::none:
      break;
  }
  return "ok";
}

}  // namespace sonoglide::work_precision
