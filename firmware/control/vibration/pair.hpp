/// Two numbers that belong together.
#pragma once

#include "firmware/numeric/headroom.hpp"

namespace sonoglide::control {

/// Two numbers: of a mode, of a vibration, or of a product with a matrix.
template <class Scalar>
struct Pair {
  Scalar first{};
  Scalar second{};
};

template <class Scalar>
constexpr Pair<Scalar> operator+(const Pair<Scalar>& a, const Pair<Scalar>& b) {
  return {a.first + b.first, a.second + b.second};
}
template <class Scalar>
constexpr Pair<Scalar> operator-(const Pair<Scalar>& a, const Pair<Scalar>& b) {
  return {a.first - b.first, a.second - b.second};
}
template <class Scalar>
constexpr Pair<Scalar> operator*(const Pair<Scalar>& a, Scalar b) {
  return {numeric::rough_product(a.first, b), numeric::rough_product(a.second, b)};
}

/// A mode that turns by an angle θ and decays to the part d. In fixed point products are rounded
/// and sums overflow by policy.
/// @param mode      its two coordinates
/// @param rotation  d cos θ and d sin θ
template <class Scalar>
constexpr Pair<Scalar> rotated(const Pair<Scalar>& mode, const Pair<Scalar>& rotation) {
  return {rotation.first * mode.first - rotation.second * mode.second,
          rotation.second * mode.first + rotation.first * mode.second};
}

}  // namespace sonoglide::control
