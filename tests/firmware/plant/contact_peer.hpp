/// Contacts by their own equations, followed by an integrator of the Boost library.
#pragma once

#include <array>
#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <cmath>
#include <cstddef>

#include "firmware/friction/dahl.hpp"
#include "firmware/friction/lugre.hpp"
#include "firmware/friction/stribeck.hpp"

namespace sonoglide::plant {

/// Friction and the derivative of what the contact remembers, at a sliding velocity.
struct Rub {
  double friction;
  double memory_rate;
};
inline Rub rub(const friction::Dahl<double>& law, double velocity, double memory) {
  return {memory, law.contact_stiffness * (velocity - std::abs(velocity) * memory)};
}
inline Rub rub(const friction::LuGre<double>& law, double velocity, double memory) {
  const double part = velocity / law.stribeck_velocity;
  const double curve = 1.0 + (law.static_friction - 1.0) * std::exp(-part * part);
  const double bending = velocity - std::abs(velocity) * memory / curve;
  return {memory + law.bristle_damping * bending + law.viscous_friction * velocity,
          law.contact_stiffness * bending};
}
/// While it slides forwards.
inline Rub rub(const friction::Stribeck<double>& law, double velocity, double /*memory*/) {
  return {1.0 - law.fall * velocity + law.rise * velocity * velocity * velocity, 0.0};
}

/// slope: of numbers and a time, their rates.
template <std::size_t Count, class Slope>
std::array<double, Count> by_odeint(const Slope& slope, std::array<double, Count> numbers,
                                    double duration, double tolerance) {
  namespace odeint = boost::numeric::odeint;
  using Formula = odeint::runge_kutta_dopri5<std::array<double, Count>>;
  odeint::integrate_adaptive(odeint::make_controlled<Formula>(tolerance, tolerance), slope, numbers,
                             0.0, duration, 1e-4);
  return numbers;
}

}  // namespace sonoglide::plant
