/// The motion computed by another method, in higher precision, far more finely.
#pragma once

#include "host_sim/studies/work_precision/peers/contender.hpp"

namespace sonoglide::work_precision {

/// How a reference is computed.
struct ReferenceSetting {
  int columns;            ///< of the extrapolation; the order is twice that
  long double tolerance;  ///< of each step, absolute
};

struct Reference {
  long double friction_ratio = 0.0L;  ///< mean phi over the whole run
  long double displacement = 0.0L;    ///< y at the end
  long double velocity = 0.0L;        ///< y' at the end
  long double friction = 0.0L;        ///< phi at the end
};

/// Gragg–Bulirsch–Stoer extrapolation in long double between the reversals of V, each of them a
/// step whose length is solved so that V = 0 at its end. Friction is a function of the distance
/// slid since the reversal, phi = s - s e0 exp(-kappa |u|), and no unknown of its own.
///
/// The friction ratio of the published cases is reached within 1e-15 where long double has 64 bits
/// of mantissa or more; tested against values of 25 digits.
/// @throws loop::ComputationError if the steps shrink to nothing
Reference compute_reference(const peers::Problem& problem, const ReferenceSetting& setting);

struct CheckedReference {
  Reference motion;
  long double error = 0.0L;  ///< of the friction ratio, absolute: how far a second run is from it
};

/// The reference of a comparison, and the same at a lower order and a looser tolerance.
CheckedReference checked_reference(const peers::Problem& problem);

}  // namespace sonoglide::work_precision
