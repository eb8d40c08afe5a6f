/// The friction laws that a scene chooses among: the one place that lists them.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "firmware/friction/vibration.hpp"
#include "host_sim/scene/contact.hpp"
#include "host_sim/scene/laws/coulomb.hpp"
#include "host_sim/scene/laws/dahl.hpp"
#include "host_sim/scene/laws/iwan.hpp"
#include "host_sim/scene/laws/lugre.hpp"
#include "host_sim/scene/laws/none.hpp"
#include "host_sim/scene/laws/normal_coulomb.hpp"
#include "host_sim/scene/laws/stribeck.hpp"
#include "host_sim/scene/laws/transverse_coulomb.hpp"

namespace sonoglide::scene {

/// A law with its own parameters; what a law offers is listed at laws::None. Messages name them in
/// this order.
using FrictionLaw = std::variant<laws::Dahl, laws::LuGre, laws::Iwan, laws::Coulomb, laws::Stribeck,
                                 laws::TransverseCoulomb, laws::NormalCoulomb, laws::None>;

inline constexpr std::size_t law_count = std::variant_size_v<FrictionLaw>;

template <std::size_t Index>
using LawAt = std::variant_alternative_t<Index, FrictionLaw>;

namespace detail {

template <std::size_t... Index>
constexpr std::array<FrictionLaw, law_count> every_law(std::index_sequence<Index...> /*all*/) {
  return {LawAt<Index>{}...};
}

}  // namespace detail

/// Each law once, its own parameters as if absent.
inline constexpr std::array<FrictionLaw, law_count> every_law =
    detail::every_law(std::make_index_sequence<law_count>{});

constexpr std::string_view name_of(const FrictionLaw& law) {
  return std::visit([](const auto& any) { return any.name; }, law);
}

/// law_count where there is no such law.
constexpr std::size_t law_index(std::string_view name) {
  std::size_t index = 0;
  while (index < law_count && name_of(every_law[index]) != name) {
    ++index;
  }
  return index;
}

template <class Law>
constexpr bool is(const FrictionLaw& law) {
  return std::holds_alternative<Law>(law);
}

/// Whether the contact yields like a spring before it slides: it has a contact stiffness, and may
/// begin under a force.
constexpr bool is_elastic(const FrictionLaw& law) {
  return std::visit([](const auto& any) { return any.elastic; }, law);
}

/// Which way the mass vibrates, seen from the sliding.
friction::Vibration vibration_of(const FrictionLaw& law);
inline bool vibrates_along(const FrictionLaw& law) {
  return vibration_of(law) == friction::Vibration::along;
}

/// The map that a controller is fed forward by.
constexpr FrictionMap friction_map(const FrictionLaw& law) {
  return std::visit([](const auto& any) { return any.map; }, law);
}

/// |F| <= Fc, and without Fc no friction.
constexpr bool is_bounded(const FrictionLaw& law) {
  return std::visit([](const auto& any) { return any.is_bounded; }, law);
}

/// Friction force of a steady slide at a speed [m/s], either way, without vibration.
inline double undriven_friction_N(const FrictionLaw& law, const ContactValues& contact,
                                  double sliding_m_per_s) {
  return std::visit(
      [&](const auto& any) { return any.undriven_N(contact, std::abs(sliding_m_per_s)); }, law);
}

/// What is wrong where the contact's memory passes the law's bound.
std::string_view broken_bound(const FrictionLaw& law);

}  // namespace sonoglide::scene
