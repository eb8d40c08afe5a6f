/// Minimal loops beside the composed ones of the cost ladder: written out, composed of nothing of
/// ours. Each is compiled for what its rung names.
///
/// The elementary functions, the search for a polynomial's first sign change and the nodes of a
/// quadrature are the product's: functions of numbers, which know of no scene. Where a loop meets
/// what its scene does not lead to, it stops, and the result has no steps. Every function is
/// inlined, what is named and the numbers of terms being literals: what they switch off is not in
/// the code.
#pragma once

#include "cost_scene.hpp"

namespace sonoglide::cost::by_hand {

enum class Law { none, coulomb, dahl };

/// What a rung names. The Taylor loop has Coulomb friction undamped, without accounts, and its
/// records and accounts with Dahl friction only; that by Runge and Kutta has no records.
struct Named {
  Law law = Law::none;
  bool driven = false;
  bool damped = false;
  bool mean_friction = false;
  bool energy = false;
  bool recorded = false;
};

/// A closed loop around the Taylor loop of a driven Dahl contact with its mean friction.
template <class Number>
Result controlled(Scene scene);

}  // namespace sonoglide::cost::by_hand
