/// The words by which a unit names its faults and its store to people.
#pragma once

#include <cstdint>

#include "firmware/app/supervisor.hpp"
#include "firmware/control/interface/names.hpp"
#include "firmware/store/two_page_store.hpp"

namespace sonoglide::app {

/// @param fault  control::Fault or UnitFault.
constexpr const char* fault_name(std::uint8_t fault) {
  switch (static_cast<UnitFault>(fault)) {
    case UnitFault::overrun:
      return "overrun";
    case UnitFault::watchdog_reset:
      return "watchdog_reset";
    case UnitFault::host_silent:
      return "host_silent";
    case UnitFault::parameters_lost:
      return "parameters_lost";
    case UnitFault::parameters_of_other_design:
      return "parameters_of_other_design";
    case UnitFault::service_stalled:
      return "service_stalled";
  }
  return control::name(static_cast<control::Fault>(fault));
}

constexpr const char* name(store::Origin origin) {
  switch (origin) {
    case store::Origin::stored:
      return "stored";
    case store::Origin::blank:
      return "blank";
    case store::Origin::other_design:
      return "other_design";
    case store::Origin::damaged:
      break;
  }
  return "damaged";
}

}  // namespace sonoglide::app
