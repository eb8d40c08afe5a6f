/// Touchstone files of one port.
#pragma once

#include <optional>

#include "host_sim/scene_file/source.hpp"
#include "host_sim/studies/identify/impedance/sweep.hpp"

namespace sonoglide::identify::impedance {

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

}  // namespace sonoglide::identify::impedance
