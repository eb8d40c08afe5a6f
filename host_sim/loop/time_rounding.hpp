/// When two times of a run are one.
#pragma once

namespace sonoglide::loop {

/// Times closer than this, in carrier periods, are one: a step that is meant to fall on a carrier
/// period misses it by the rounding of its decimal figure.
inline constexpr double time_rounding = 1e-9;

}  // namespace sonoglide::loop
