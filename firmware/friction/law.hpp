/// What a friction law offers to the plant: the list, and its check at compile time.
#pragma once

#include <type_traits>
#include <utility>

#include "firmware/friction/vibration.hpp"

namespace sonoglide::friction {

/// A friction law gives phi = F/Fc [-] in [-1, 1] in terms of the sliding velocity V = du/d tau. It
/// offers:
///   vibration            which way the mass vibrates, seen from the sliding
///   reverses             phi depends on sgn V, so that an event solver stops where V changes sign
///   varies               phi changes between two reversals
///   sticks               V may stay zero while a friction force below Fc holds it there
///   rate_independent     between two reversals phi depends on the displacement alone
///   remembers            phi is not all that the contact knows of its past
///   has_corners          the slope d phi / du may jump between two reversals
///   friction(V, phi)     the friction that acts now, phi being its last value
///   rate(V, phi)         d phi / d tau, for step-by-step methods; 0 where V alone sets phi
///   series_unit(V, phi, tau)  time, at most tau, in which the power series is written: its
///                        coefficients stay moderate
/// A law that is rate independent:
///   Arc                  the law between two reversals, where sgn V = direction is constant:
///     coefficient<N>(travel, earlier)  N-th Taylor coefficient of phi in x = time / unit, from
///                          those of travel, du/dx, and of phi itself, below N
///     friction_after(du)   phi exactly, after the displacement du >= 0 along the direction
///     friction_along(du)   only if it varies: the same at a group of lanes, for du from a rounding
///                          error below 0. Absolute error 1e-9 (double), 5e-6 (float); in double
///                          1e-13 as long as it has relaxed by less than a factor of e^6
///     work(du)             integral of phi V d tau exactly, over the same displacement
/// A law that is not rate independent offers in place of Arc:
///   reach(V)             change of V over which a power series of the law is valid
///   Series<Order>        such a series, sgn V = direction being constant:
///     coefficient<N>(travel, unit)  N-th Taylor coefficient of phi in x = time / unit, from those
///                          of travel up to N
/// A law that remembers has a Memory, which takes the place of phi as an argument of friction, rate
/// and series_unit and is what rate gives the derivative of. It also offers:
///   largest_memory()     no motion takes |Memory| beyond it
///   memory_at(phi)       the Memory of a contact that has been loaded to phi for the first time
///   Series<Order>::memory(x)  the Memory at x; where rate independent,
///   Arc::memory_after(du)     the Memory after the displacement du
/// A law that vibrates across the sliding takes for V a Slip, along and across, and has
///   friction_across(V)   the friction on the oscillator, phi being that along the sliding
///   Series<Order>        of the friction across, from the coefficients of either velocity; it also
///                        has friction_along(n), the n-th coefficient of phi
/// A law that vibrates normally to the surface has a pressure and a limit of |phi| in terms of the
/// displacement y, and a spring in front of its slider: friction::NormalCoulomb.
/// A law along the sliding that has corners is rate independent and remembers; its rate is not
/// used. It also offers:
///   Arc::to_corner()     the displacement, along the direction, to the first of them, or infinity
///
/// check_law<Law>() names the first member that is missing. friction::None is the shortest law,
/// friction::Dahl the one to read next.
namespace detail {

template <class Law, class = void>
struct HasTraits : std::false_type {};
template <class Law>
struct HasTraits<
    Law, std::void_t<decltype(Law::vibration), decltype(Law::reverses), decltype(Law::varies),
                     decltype(Law::sticks), decltype(Law::rate_independent),
                     decltype(Law::remembers), decltype(Law::has_corners)>> : std::true_type {};

template <class Law, class = void>
struct HasArc : std::false_type {};
template <class Law>
struct HasArc<Law, std::void_t<typename Law::Arc>> : std::true_type {};

template <class Law, class = void>
struct HasMemory : std::false_type {};
template <class Law>
struct HasMemory<
    Law, std::void_t<typename Law::Memory, decltype(std::declval<const Law&>().largest_memory()),
                     decltype(std::declval<const Law&>().memory_at(
                         std::declval<typename Law::Scalar>()))>> : std::true_type {};

template <class Law, class = void>
struct HasFriction : std::false_type {};
template <class Law>
struct HasFriction<
    Law, std::void_t<decltype(std::declval<const Law&>().friction(
             std::declval<typename Law::Scalar>(), std::declval<typename Law::Scalar>()))>>
    : std::true_type {};

}  // namespace detail

/// True if Law is a friction law; otherwise it fails to compile, with the reason.
template <class Law>
constexpr bool check_law() {
  static_assert(detail::HasTraits<Law>::value,
                "a friction law has the constants vibration, reverses, varies, sticks, "
                "rate_independent, remembers and has_corners: see friction/law.hpp");
  if constexpr (detail::HasTraits<Law>::value) {
    static_assert(!Law::remembers || detail::HasMemory<Law>::value,
                  "a friction law that remembers has Memory, largest_memory() and memory_at(phi): "
                  "see friction/law.hpp");
    if constexpr (Law::vibration == Vibration::along) {
      static_assert(!Law::rate_independent || detail::HasArc<Law>::value,
                    "a rate-independent friction law has an Arc: see friction/law.hpp");
      static_assert(Law::remembers || detail::HasFriction<Law>::value,
                    "a friction law has friction(V, phi): see friction/law.hpp");
    }
  }
  return true;
}

}  // namespace sonoglide::friction
