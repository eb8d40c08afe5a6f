/// The parameters with which a unit begins.
#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware/app/field_parameters.hpp"
#include "firmware/store/two_page_store.hpp"

namespace sonoglide::app {

/// Those of the store if it holds all of them, under this design and within their ranges. Otherwise those that are
/// compiled in, with the limits that the store holds (Inheritance).
template <class Design, class Flash>
struct LoadedParameters {
  using Store = store::TwoPageStore<Flash, parameter_count>;

  [[gnu::cold]] LoadedParameters(const Design& design, Flash& flash)
      : store(flash, design.design()), values(design.presets()), origin(load(design)) {}

  Store store;
  ParameterValues values;
  store::Origin origin;  ///< as found; damaged too where a whole record is out of range

 private:
  store::Origin load(const Design& design) {
    const store::Origin found = store.load();
    if (found == store::Origin::stored && take_all(design)) {
      return found;
    }
    take_limits(design);
    return found == store::Origin::stored ? store::Origin::damaged : found;
  }

  /// @return false, and nothing taken, unless each parameter is there and within its range.
  bool take_all(const Design& design) {
    ParameterValues stored{};
    for (std::size_t i = 0; i < parameter_count; ++i) {
      if (!store.find(parameter_identities[i], stored[i])) {
        return false;
      }
    }
    const bool allowed = design.allows(stored);
    values = allowed ? stored : values;
    return allowed;
  }

  void take_limits(const Design& design) {
    for (std::size_t i = 0; i < parameter_count; ++i) {
      std::uint32_t stored = 0;
      if (store.find(parameter_identities[i], stored)) {
        values[i] = design.range(i).inherited(stored);
      }
    }
  }
};

}  // namespace sonoglide::app
