/// Which solvers a scene may have, and which one it gets.
#pragma once

#include "host_sim/scene/friction_laws.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::scene {

/// Whether a solver takes a law, as the solver of the core says itself.
bool solves(SolverMethod method, const FrictionLaw& law);

/// The method of a scene that names none: event_gauss where it takes nearly every carrier period in
/// one step and is the faster, otherwise event_taylor. Both keep to the tolerance in every scene
/// that they take; the choice is of speed alone.
///
/// It is event_gauss if the law, the drive and the spring of the scene let one table of the motion
/// serve the whole run, and if, with V the peak velocity of the vibration and w = 2 pi f,
///   0.1 <= Kt V / (w Fc) <= 1                     Dahl number: below, event_taylor is as fast
///   Fc / (m w V) <= 0.2 tolerance^(1/3)           the friction hardly moves a reversal
///   Kt / (m w^2) <= (3 tolerance)^(1/4) / (4 pi^2)   nor does it bend the motion
///   Ks <= m w^2 / 4,  c <= m w / 10               the natural mode is slow
///   V >= 4/3 |Vt|                                 the vibration reverses the sliding
///   1e-10 <= tolerance <= 1e-5
/// In closed loop V is taken as sqrt(2) |Vt|, which halves the friction of a Coulomb contact. The
/// limits were found with 3000 random plants; of those that they pick one in 20 runs slower than
/// with event_taylor, by a tenth or more.
SolverMethod fastest_method(const Scene& scene);

}  // namespace sonoglide::scene
