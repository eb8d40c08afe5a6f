/// What a selection of a circuit leaves uncertain.
#pragma once

#include "host_sim/studies/identify/impedance/selection.hpp"

namespace sonoglide::identify::impedance {

/// Whether the phases are off by more than chance explains.
bool sees_rotation(const CircuitFit& fit);

bool sees_lead_or_rotation(const CircuitFit& fit);

/// Makes the fit's covariance allow for what the noise may be (average_over_noise), for the other circuits
/// that may be the right one, and for misfit; names those that may be a lead or a rotation that is seen,
/// and the parts that may be there unseen.
///
/// Averages the covariance over the other circuits (a further mode, a lean, other leads), each with its own and the square of the step to
/// it, weighted by its likelihood less a penalty: Schwarz's, ln n for each parameter; of a further mode
/// two thirds of it, with which the intervals hold beside modes too weak to be seen; and 1 for a
/// resistance of leads in place of a rotation that is not seen, since leads are always there.
/// Source: Kass and Raftery, Journal of the American Statistical Association 90 (1995).
///
/// Where the circuit does not describe the sweep, as if as much of the misfit lay along each
/// parameter's direction as along any other that is as wide: (Jᵀ J)⁻¹ S/p is added, S the misfit's sum of
/// squares and p the number of parameters.
void allow_for_what_is_not_certain(Selection& selected);

}  // namespace sonoglide::identify::impedance
