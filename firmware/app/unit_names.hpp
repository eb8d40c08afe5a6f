/// The words by which a unit names its faults and its store to people.
#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware/app/supervisor.hpp"
#include "firmware/control/interface/names.hpp"
#include "firmware/store/two_page_store.hpp"

namespace sonoglide::app {

namespace detail {

/// "external_1" ... "external_31"; nothing has the cause 0.
struct ExternalNames {
  char of[last_external_cause + 1][sizeof "external_31"]{};

  /// At compile time.
  constexpr ExternalNames() {
    constexpr char word[] = "external_";
    for (unsigned cause = 1; cause <= last_external_cause; ++cause) {
      std::size_t size = 0;
      for (; word[size] != '\0'; ++size) {
        of[cause][size] = word[size];
      }
      if (cause >= 10) {
        of[cause][size++] = static_cast<char>('0' + cause / 10);
      }
      of[cause][size] = static_cast<char>('0' + cause % 10);
    }
  }
};
inline constexpr ExternalNames external_names;

}  // namespace detail

/// @param fault  control::Fault or UnitFault.
constexpr const char* fault_name(std::uint8_t fault) {
  constexpr auto external = static_cast<std::uint8_t>(UnitFault::external);
  if (external < fault && fault <= external + last_external_cause) {
    return detail::external_names.of[fault - external];
  }
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
    case UnitFault::image_damaged:
      return "image_damaged";
    case UnitFault::external:
      break;
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
