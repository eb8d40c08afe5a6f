/// The angle of a whole turn.
#pragma once

namespace sonoglide::numeric {

/// 2 pi [rad], to the nearest double.
inline constexpr double two_pi = 6.28318530717958647693;

}  // namespace sonoglide::numeric
