/// A measured sweep of an impedance, whatever file it comes from.
#pragma once

#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "host_sim/scene_file/source.hpp"

namespace sonoglide::identify::impedance {

/// Of an admittance, over rising frequencies. Of a file of magnitudes alone the values are real and
/// positive.
struct Sweep {
  std::string format;  ///< what the file was taken for, in words
  std::vector<double> frequency_Hz;
  std::vector<std::complex<double>> admittance_S;
  bool has_phase = false;
  std::vector<std::string> warnings;  ///< what was assumed, each a sentence
};

// Files of impedance sweeps.

// The text export of an Agilent 4294A and its relatives.

/// Blocks `"TRACE: A"` and `"TRACE: B"`, each with a heading that begins with "Frequency" and, below
/// it, lines of frequency, real and imaginary part of the trace, with or without those of the memory
/// trace. What the traces are says a line as `"MEASURE PARAMETER: ADMITTANCE MAG PHASE (DEG)"`, or
/// `"FORMAT: |Z|"` of each; `FORMAT: LOG` and `LIN` are of the screen. Where nothing is named they
/// are taken for |Z| in ohm and its phase in degrees, and a warning says so. A trace with imaginary
/// parts is a complex impedance or admittance; one trace alone without is a magnitude.
/// @return nothing of a text without a line `"TRACE: A"`
/// @throws scene_file::SceneError  at the place of what is wrong
/// Source: files of others, as several public readers of them take them.
std::optional<Sweep> read_traces(const scene_file::Source& source);

// Touchstone files of one port.

/// S, Y or Z, as real and imaginary part (RI), magnitude and degrees (MA), or dB and degrees (DB), in
/// Hz to GHz. Without an option line: GHz, S, MA, 50 ohm. Numbers may have decimal commas, and commas
/// may stand between them. In version 1 Y and Z are read as the standard has them, Z over the
/// reference resistance and Y times it; in version 2 they are in S and ohm.
/// @return nothing of a text without an option line, `#` and nothing but words of such a line, and
///         without a keyword `[Version]`, if the file's name does not end with .s1p
/// @throws scene_file::SceneError  at the place of what is wrong
/// Source: Touchstone file format specification, revision 1.1 (EIA/IBIS Open Forum, 2002), and version
/// 2.0 (IBIS Open Forum, 2009).
std::optional<Sweep> read_touchstone(const scene_file::Source& source);

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
