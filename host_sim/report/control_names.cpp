#include "host_sim/report/control_names.hpp"

#include "firmware/control/names.hpp"

namespace sonoglide::report {

std::string limit_name(control::Limit limit) {
  return control::name(limit);
}

std::string fault_name(control::Fault fault) {
  return control::name(fault);
}

}  // namespace sonoglide::report
