/// Many independent plants at once, one in each SIMD lane.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "host_sim/batch/dahl_run.hpp"

namespace sonoglide::batch {

/// What the friction ratio is to be good for: its relative error in a sweep of Table 1 from rest,
/// 100 periods, velocity ratio 0.05 to 1.2. Where the natural frequency exceeds the drive's, or in
/// very stiff contacts, the error may be ten times as large; in mean phi itself, so it matters
/// where that is close to 0.
enum class Accuracy {
  map,   ///< 1e-4: float32 lanes
  fine,  ///< 1e-8: float64 lanes
};

/// The instruction set of this machine that the lanes use: it decides the last bit.
std::string instruction_set();

/// Runs `count` plants by the event-located Taylor method; runs[i] is that of plants[i].
///
/// Steps end at the reversals of V, and none is passed over. Between them friction follows the
/// displacement exactly: |phi| <= 1 always, and the friction work is exact for the path taken.
/// A point's result is the same, bit for bit, whatever its lane, its neighbours and the way a
/// caller divides the points among threads; from one instruction set to another only the rounding
/// differs (a fused multiply-add where there is one). A point that the lanes give up says so in its
/// status, in time, and disturbs no other: let plant::EventTaylor solve it.
void run_dahl_plants(const DahlPlant* plants, std::size_t count, const RunLength& length,
                     Accuracy accuracy, DahlRun* runs);

std::vector<DahlRun> run_dahl_plants(const std::vector<DahlPlant>& plants, const RunLength& length,
                                     Accuracy accuracy);

}  // namespace sonoglide::batch
