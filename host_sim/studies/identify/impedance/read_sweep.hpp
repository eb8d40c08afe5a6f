/// Files of impedance sweeps.
#pragma once

#include "host_sim/scene_file/source.hpp"
#include "host_sim/studies/identify/impedance/sweep.hpp"

namespace sonoglide::identify::impedance {

/// Reads, by what the text looks like:
/// - the text export of an Agilent 4294A: blocks `"TRACE: A"` and `"TRACE: B"`;
/// - Touchstone, versions 1 and 2, one port (option line `#`): S, Y or Z as RI, MA or DB;
/// - a table with named columns (see MeasuredTable): a frequency, and magnitude and phase, real and
///   imaginary part, or the magnitude alone, of an impedance or an admittance.
/// Rows may come in any order. Of a frequency that is there several times the mean admittance is
/// taken, and a warning says so.
/// @throws scene_file::SceneError  at the place of what is wrong
Sweep read_sweep(const scene_file::Source& source);

}  // namespace sonoglide::identify::impedance
