/// A scene without friction, and the list of what every friction law tells the workstation program.
#pragma once

#include <string_view>

#include "host_sim/scene/contact.hpp"

namespace sonoglide::friction {
template <class Number>
struct None;
}

namespace sonoglide::scene::laws {

/// No friction. A law, named as its file is, has its own parameters in SI units, the unit in the
/// name, and beside them:
///   name             its word: friction.law = "..."
///   Core<Scalar>     the law of the core, declared only: what composes plants of it includes
///                    law_cores.hpp
///   elastic          it yields like a spring before it slides: it takes contact_stiffness_N_per_m
///                    and initial_force_N, and its force is part of the state
///   map              how a controller is fed forward: by the inverse of the law's own map, tabulated
///                    with the design where the controller has none of this law
///   is_bounded       |F| <= Fc, and as Fc goes to 0 so does the law to no friction: a profile of
///                    the friction may reach 0
///   undriven_N(contact, speed)  friction force of a steady slide at a speed >= 0 without vibration
///   visit_keys(keys, contact)  its own keys of [friction], in order: for each
///     keys.required(key, parameter, range, meaning) or
///     keys.optional(key, parameter, range, meaning), which leaves the parameter as it is where
///     absent,
///     keys.optional(key, count, least, most, meaning), the same for an integer, and
///     keys.refuse(key, parameter, finding, least, rest) where the others make it too small;
///     the meaning is one line for the reference of keys, without a final stop
///   core<Scalar>(contact, scales)  the law of the core in dimensionless numbers; there is friction
/// A law of the core that remembers more than its force also has
///   bound_broken     what is wrong where that passes its bound
struct None {
  static constexpr std::string_view name = "none";
  template <class Scalar>
  using Core = friction::None<Scalar>;
  static constexpr bool elastic = false;
  static constexpr FrictionMap map = FrictionMap::coulomb;
  static constexpr bool is_bounded = true;

  template <class Keys>
  void visit_keys(Keys& /*keys*/, const ContactValues& /*contact*/) {}

  double undriven_N(const ContactValues& /*contact*/, double /*speed_m_per_s*/) const {
    return 0.0;
  }
};

}  // namespace sonoglide::scene::laws
