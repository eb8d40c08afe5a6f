/// The text export of an Agilent 4294A and its relatives.
#pragma once

#include "host_sim/scene_file/source.hpp"
#include "host_sim/studies/identify/impedance/sweep.hpp"

namespace sonoglide::identify::impedance {

/// Whether the text has a line `"TRACE: A"`.
bool is_trace_export(const scene_file::Source& source);

/// Blocks `"TRACE: A"` and `"TRACE: B"`, each with a heading that begins with "Frequency" and, below
/// it, lines of frequency, real and imaginary part of the trace, with or without those of the memory
/// trace. Two traces are what the lines above them name, as |Z| and theta, R and X, G and B, |Y| and
/// theta; where nothing is named they are taken for |Z| in ohm and its phase in degrees, and a
/// warning says so. One trace alone is a complex impedance where it has imaginary parts, else |Z|.
/// @throws scene_file::SceneError  at the place of what is wrong
/// Source: files of others, as several public readers of them take them.
Sweep read_traces(const scene_file::Source& source);

}  // namespace sonoglide::identify::impedance
