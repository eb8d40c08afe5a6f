/// Circuits to begin a fit from, out of the data alone.
#pragma once

#include <vector>

#include "host_sim/studies/identify/impedance/circuit_fit.hpp"
#include "host_sim/studies/identify/impedance/sweep.hpp"

namespace sonoglide::identify::impedance {

/// Circuits of one mode that come near the sweep, the best first; at most `most`.
///
/// Places are the readings with the largest local maxima of G/ω, of magnitudes alone of |Y|/ω, and
/// the middles beside them; bandwidths are tried from a third of the frequency down to 1/300 000 of
/// it. With phase, capacitance, loss and conductance follow by linear least squares; without, the
/// ratio of the capacitances is tried too.
std::vector<Circuit> start_circuits(const Sweep& sweep, std::size_t most);

/// A further mode that the residuals of a fit ask for most: the fit's circuit with it, at most
/// `most`, the best first. Each is tried at places all over the sweep and bandwidths of a few
/// readings and more, by what of the residuals its admittance takes away that a change of the
/// circuit does not.
std::vector<Circuit> circuits_with_another_mode(const Sweep& sweep, const CircuitFit& fit,
                                                std::size_t most);

}  // namespace sonoglide::identify::impedance
