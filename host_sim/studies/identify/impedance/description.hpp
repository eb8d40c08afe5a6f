/// How well a circuit describes a sweep.
#pragma once

#include "host_sim/studies/identify/impedance/circuit_fit.hpp"

namespace sonoglide::identify::impedance {

/// Root mean squares relative to the fitted admittance, a reading with phase counting once.
struct Description {
  double residual;
  double scatter;  ///< the part of it from reading to reading; its rest is misfit

  double misfit() const;  ///< root mean square too
  /// Residuals above twice the scatter, and above 0.1 %.
  bool fails() const;
};

/// The scatter is taken from the differences of neighbouring residuals, each over the size that the
/// noise gives it, by the 90th percentile of them: flanks of modes that are not fitted are few.
Description describe(const CircuitFit& fit);

/// What misfit adds to the covariance of the parameters where the description fails: as if as much
/// of it lay along each parameter's direction as along any other that is as wide, (Jᵀ J)⁻¹ S/p, S the
/// misfit's sum of squares and p the number of parameters.
void allow_for_misfit(CircuitFit& fit);

}  // namespace sonoglide::identify::impedance
