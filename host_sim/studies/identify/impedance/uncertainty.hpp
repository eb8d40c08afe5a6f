/// What a selection of a circuit leaves uncertain.
#pragma once

#include <vector>

#include "host_sim/studies/identify/impedance/selection.hpp"

namespace sonoglide::identify::impedance {

/// Leads and errors of the phase, which look like each other.
inline constexpr Part parts_of_phase[] = {Part::rotation, Part::lead_resistance,
                                          Part::lead_inductance};

/// Whether the phases are off by more than chance explains.
bool sees_rotation(const CircuitFit& fit);

bool sees_lead_or_rotation(const CircuitFit& fit);

/// The other leads and rotations that may be what is seen of one.
std::vector<CircuitFit> rivals_of_phase(const Sweep& sweep, const CircuitFit& fit);

/// Makes the fit's covariance allow for correlation along the sweep, for the other circuits that may
/// be the right one, and for misfit; names those that may be a lead or a rotation that is seen, and
/// the parts that may be there unseen.
///
/// Averages the covariance over the other circuits, each with its own and the square of the step to
/// it, weighted by its likelihood less a penalty: Schwarz's, ln n for each parameter; 1 for a
/// resistance of leads in place of a rotation that is not seen, since leads are always there.
/// Source: Kass and Raftery, Journal of the American Statistical Association 90 (1995).
void allow_for_what_is_not_certain(const Sweep& sweep, Selection& selected);

}  // namespace sonoglide::identify::impedance
