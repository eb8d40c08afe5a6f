/// The angles of half and of a whole turn.
#pragma once

namespace sonoglide::numeric {

/// pi and 2 pi [rad], each to the nearest double.
inline constexpr double half_turn = 3.14159265358979323846;
inline constexpr double two_pi = 2.0 * half_turn;

}  // namespace sonoglide::numeric
