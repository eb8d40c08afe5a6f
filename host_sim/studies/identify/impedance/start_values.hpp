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

/// Modes that are nearer than so many band widths look like a single peak that is not that of a linear
/// mode.
inline constexpr double least_distance_bands = 2.0;

/// What a further mode or part has to take from −2 ln likelihood, by its linearisation, to be fitted:
/// anything where the fit does not describe the sweep.
double gain_to_fit(const CircuitFit& fit);

enum class Place { inside, beside };

/// A further mode that the residuals of a fit ask for most: the fit's circuit with it behind the
/// others, at most `most`, the best first; none where none takes gain_to_fit. Each is tried at places
/// all over the sweep, apart from the other modes, with bandwidths of a few readings and more; or just
/// outside the sweep, with the quality of the first mode.
std::vector<Circuit> circuits_with_another_mode(const Sweep& sweep, const CircuitFit& fit,
                                                Place place, std::size_t most);

}  // namespace sonoglide::identify::impedance
