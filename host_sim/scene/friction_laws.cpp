#include "host_sim/scene/friction_laws.hpp"

#include <type_traits>
#include <variant>

#include "host_sim/scene/law_cores.hpp"

namespace sonoglide::scene {
namespace {

template <class Law>
using CoreOf = typename std::decay_t<Law>::template Core<double>;

}  // namespace

friction::Vibration vibration_of(const FrictionLaw& law) {
  return std::visit([](const auto& any) { return CoreOf<decltype(any)>::vibration; }, law);
}

std::string_view broken_bound(const FrictionLaw& law) {
  return std::visit(
      [](const auto& any) -> std::string_view {
        if constexpr (CoreOf<decltype(any)>::remembers) {
          return any.bound_broken;
        }
        return "|F| > Fc";
      },
      law);
}

}  // namespace sonoglide::scene
