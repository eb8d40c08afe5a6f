/// Where inside a step the travel reaches a corner of the friction law.
#pragma once

#include <limits>

#include "firmware/numeric/scalar.hpp"

namespace sonoglide::plant {

/// The x in (0, end] at which a travel that does not turn back has gone `distance` > 0, within some
/// roundings of the distance. `end` if the travel is shorter.
///
/// @param series     of the travel over x: offers travelled(x) and its derivative travel_rate(x).
/// @param direction  of the travel, +1 or -1.
/// @param distance   from x = 0 to the corner, along the direction.
/// @param end        of the step.
/// Newton's method between bounds: a step that would leave them is replaced by halving.
template <class Series, class Scalar>
Scalar corner(const Series& series, Scalar direction, Scalar distance, Scalar end) {
  const Scalar whole = direction * series.travelled(end);
  if (!(whole > distance)) {
    return end;
  }
  const Scalar rounding = Scalar(2) * std::numeric_limits<Scalar>::epsilon();
  Scalar low = Scalar(0);
  Scalar high = end;
  Scalar x = end * (distance / whole);
  while (low < x && x < high) {
    const Scalar beyond = direction * series.travelled(x) - distance;
    if (numeric::abs(beyond) <= rounding * distance) {
      return x;
    }
    (beyond > Scalar(0) ? high : low) = x;
    const Scalar newton = x - direction * beyond / series.travel_rate(x);
    x = low < newton && newton < high ? newton : low + numeric::half(high - low);
  }
  return high;
}

}  // namespace sonoglide::plant
