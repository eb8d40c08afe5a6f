/// Circuits to begin a fit from, out of the data alone.
#pragma once

#include <vector>

#include "host_sim/studies/identify/impedance/circuit_fit.hpp"
#include "host_sim/studies/identify/impedance/sweep.hpp"

namespace sonoglide::identify::impedance {

struct Start {
  double misfit = 0.0;  ///< a sum of squares; of a further mode less what it takes away
  Circuit circuit;
};

/// Circuits of one mode that come near the sweep, the best first; at most `most`.
///
/// Places are the readings with the largest local maxima of G/ω, of magnitudes alone of |Y|/ω, and
/// the middles beside them; bandwidths are tried from a third of the frequency down to 1/300 000 of
/// it. Capacitance C, loss and conductance G follow by linear least squares: of Y, or of magnitudes
/// alone of |Y|², which is linear in C², C G and G².
std::vector<Start> start_circuits(const Sweep& sweep, std::size_t most);

/// A fit's circuit with a further mode behind the others that the residuals ask for most, at most
/// `most`, the best first. Tried are places all over the sweep and where residuals are largest, with
/// bandwidths of a few readings and more; and of sweeps with phase places just outside, with the
/// quality of the first mode. Each by what of the residuals it takes away that a change of the circuit
/// does not; those that take less than `least` from −2 ln likelihood are none.
std::vector<Start> starts_with_another_mode(const Sweep& sweep, const CircuitFit& fit, double least,
                                            std::size_t most);

}  // namespace sonoglide::identify::impedance
