/// Minimal loops, one for each rung of the cost ladder: written out, composed of nothing of ours.
///
/// The elementary functions, the search for a polynomial's first sign change and the nodes of a
/// quadrature are the product's: functions of numbers, which know of no scene. Where a loop meets
/// what its scene does not lead to, it stops, and the result has no steps.
#pragma once

#include "cost_scene.hpp"

namespace sonoglide::cost::by_hand {

Result free_oscillator(const Scene& scene);
Result damped_oscillator(const Scene& scene);
Result driven_oscillator(const Scene& scene);
Result driven_damped_oscillator(const Scene& scene);

Result coulomb(const Scene& scene);

Result undriven_dahl(const Scene& scene);
Result dahl(const Scene& scene);
Result damped_dahl(const Scene& scene);
Result dahl_mean_friction(const Scene& scene);
Result dahl_energy(const Scene& scene);
Result dahl_recorded(const Scene& scene, double* record);
Result everything(const Scene& scene, double* record);

/// One carrier period of a driven Dahl contact with its mean friction; false where it fails.
/// longest: the step that the tolerance allows.
bool advance_dahl(Result& state, const Scene& scene, double longest);
Result controlled_float32(const Scene& scene);
Result controlled_q31(const Scene& scene);

Result rk4_free_oscillator(const Scene& scene);
Result rk4_damped_oscillator(const Scene& scene);
Result rk4_driven_oscillator(const Scene& scene);
Result rk4_driven_damped_oscillator(const Scene& scene);
Result rk4_coulomb(const Scene& scene);
Result rk4_undriven_dahl(const Scene& scene);
Result rk4_dahl(const Scene& scene);
Result rk4_damped_dahl(const Scene& scene);
Result rk4_dahl_energy(const Scene& scene);

}  // namespace sonoglide::cost::by_hand
