/// The text export of an Agilent 4294A and its relatives.
#pragma once

#include <optional>

#include "host_sim/scene_file/source.hpp"
#include "host_sim/studies/identify/impedance/sweep.hpp"

namespace sonoglide::identify::impedance {

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

}  // namespace sonoglide::identify::impedance
