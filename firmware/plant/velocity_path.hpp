/// A velocity inside one step, from what is known at the ends of the step.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "firmware/numeric/float_format.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::plant {

/// A velocity and its time derivative.
template <class Scalar>
struct PathEnd {
  Scalar velocity;
  Scalar acceleration;
};

/// Places, as fractions of the step, where a velocity changes sign; in order.
template <class Scalar>
struct Reversals {
  std::array<Scalar, 4> at{};
  std::size_t count = 0;
};

/// The quartic that has a velocity's values and slopes at both ends of a step, and its integral.
///
/// Written in Bernstein polynomials of x = offset / length: where the coefficients have one sign,
/// so has the quartic. Error O(length^5) of the velocity, O(length^6) of the displacement.
template <class Scalar>
class VelocityPath {
 public:
  /// mean_velocity: displacement over the step / length.
  VelocityPath(const PathEnd<Scalar>& begin, const PathEnd<Scalar>& end, Scalar mean_velocity,
               Scalar length)
      : length_(length) {
    const Scalar quarter = length * quarter_;
    const Scalar second = begin.velocity + quarter * begin.acceleration;
    const Scalar fourth = end.velocity - quarter * end.acceleration;
    const Scalar others = (begin.velocity + end.velocity) + (second + fourth);
    c_ = {begin.velocity, second, Scalar(5) * mean_velocity - others, fourth, end.velocity};
  }

  /// The sliding velocity V that goes with this velocity of the oscillator.
  /// sliding_velocity, sliding_acceleration: r at the beginning of the step, and dr / d tau.
  template <class Contact>
  VelocityPath sliding(const Contact& contact, Scalar sliding_velocity,
                       Scalar sliding_acceleration) const {
    VelocityPath path = *this;
    const Scalar rise = sliding_acceleration * length_ * quarter_;
    for (std::size_t i = 0; i < 5; ++i) {
      path.c_[i] =
          contact.contact_velocity(sliding_velocity + static_cast<Scalar>(i) * rise, c_[i]);
    }
    return path;
  }

  /// Second derivatives at the ends, times length^2.
  struct Bends {
    Scalar begin;
    Scalar end;
  };
  Bends end_bends() const {
    return {Scalar(12) * ((c_[0] - c_[1]) + (c_[2] - c_[1])),
            Scalar(12) * ((c_[4] - c_[3]) + (c_[2] - c_[3]))};
  }

  Scalar begin_velocity() const { return c_[0]; }
  Scalar end_velocity() const { return c_[4]; }
  Scalar velocity(Scalar x) const {
    const Coefficients p = powers(c_);
    return (((p[4] * x + p[3]) * x + p[2]) * x + p[1]) * x + p[0];
  }

  /// Travelled since the beginning of the step.
  Scalar displacement(Scalar x) const {
    const Coefficients p = powers(c_);
    const Scalar mean =
        (((p[4] * fifth_ * x + p[3] * quarter_) * x + p[2] * third_) * x + p[1] * half_) * x + p[0];
    return length_ * x * mean;
  }
  /// Travelled over the whole step.
  Scalar displacement() const {
    return length_ * fifth_ * (((c_[0] + c_[4]) + (c_[1] + c_[3])) + c_[2]);
  }

  /// False if the velocity certainly keeps its sign.
  bool may_reverse() const {
    const Scalar lowest =
        numeric::min(numeric::min(numeric::min(c_[0], c_[1]), numeric::min(c_[3], c_[4])), c_[2]);
    const Scalar highest =
        numeric::max(numeric::max(numeric::max(c_[0], c_[1]), numeric::max(c_[3], c_[4])), c_[2]);
    return lowest < Scalar(0) && highest > Scalar(0);
  }

  /// Sign at the beginning; if that is zero, where it goes from there. 0 if it stays zero.
  Scalar first_direction() const { return last_sign({c_[4], c_[3], c_[2], c_[1], c_[0]}, {}); }

  /// Every reversal, but for pairs closer together than 2^-10 of the step.
  ///
  /// Pieces are halved until the signs of their coefficients change no more than once.
  Reversals<Scalar> reversals() const {
    constexpr std::uint32_t whole = 1U << 10U;
    Reversals<Scalar> found;
    Scalar before = first_direction();
    std::uint32_t position = 0;
    std::uint32_t width = whole;
    while (position < whole) {
      const Scalar begin = fraction(position);
      const Coefficients piece = part(begin, fraction(position + width));
      const int changes = sign_changes(piece, before);
      if (changes > 1 && width > 1) {
        width /= 2;
        continue;
      }
      if (changes % 2 == 1 && found.count < found.at.size()) {
        found.at[found.count++] = begin + fraction(width) * only_root(piece, before);
      }
      before = last_sign(piece, before);
      position += width;
      width = position & (0U - position);
    }
    return found;
  }

 private:
  using Coefficients = std::array<Scalar, 5>;

  static constexpr Scalar half_ = numeric::from_real<Scalar>(1.0 / 2.0);
  static constexpr Scalar third_ = numeric::from_real<Scalar>(1.0 / 3.0);
  static constexpr Scalar quarter_ = numeric::from_real<Scalar>(1.0 / 4.0);
  static constexpr Scalar fifth_ = numeric::from_real<Scalar>(1.0 / 5.0);

  static Scalar fraction(std::uint32_t position) {
    return static_cast<Scalar>(position) * numeric::power_of_two<Scalar>(-10);
  }

  /// The same quartic in powers of x.
  static Coefficients powers(const Coefficients& c) {
    return {c[0], Scalar(4) * (c[1] - c[0]), Scalar(6) * ((c[0] - c[1]) + (c[2] - c[1])),
            Scalar(4) * ((c[3] - c[0]) + Scalar(3) * (c[1] - c[2])),
            (c[0] + c[4]) - Scalar(4) * (c[1] + c[3]) + Scalar(6) * c[2]};
  }

  /// The same quartic in Bernstein polynomials of a part of the step.
  Coefficients part(Scalar begin, Scalar end) const {
    Coefficients c = c_;
    if (end < Scalar(1)) {
      for (std::size_t first = 1; first < 5; ++first) {
        for (std::size_t i = 4; i >= first; --i) {
          c[i] = c[i - 1] + end * (c[i] - c[i - 1]);
        }
      }
    }
    if (begin > Scalar(0)) {
      const Scalar x = begin / end;
      for (std::size_t level = 4; level > 0; --level) {
        for (std::size_t i = 0; i < level; ++i) {
          c[i] += x * (c[i + 1] - c[i]);
        }
      }
    }
    return c;
  }

  /// Zeros apart, and beginning with the sign that came before.
  static int sign_changes(const Coefficients& c, Scalar before) {
    int changes = 0;
    for (const Scalar value : c) {
      const Scalar here = numeric::sign(value);
      changes += here * before < Scalar(0) ? 1 : 0;
      before = here != Scalar(0) ? here : before;
    }
    return changes;
  }
  static Scalar last_sign(const Coefficients& c, Scalar before) {
    for (const Scalar value : c) {
      before = value != Scalar(0) ? numeric::sign(value) : before;
    }
    return before;
  }

  /// Where the coefficients of a piece leave the sign `direction`, as a broken line.
  static Scalar broken_line_root(const Coefficients& c, Scalar direction) {
    std::size_t i = 0;
    while (direction * c[i] >= Scalar(0)) {
      ++i;
    }
    return i == 0 ? Scalar(0)
                  : quarter_ * (static_cast<Scalar>(i - 1) + c[i - 1] / (c[i - 1] - c[i]));
  }

  /// Where a piece changes from the sign `direction` to the other one, which it does once; zeros at
  /// its ends do not count. The displacement is stationary there, so half of the digits of the root
  /// give all digits of the displacement.
  static Scalar only_root(const Coefficients& c, Scalar direction) {
    constexpr int digits = std::numeric_limits<Scalar>::digits;
    constexpr Scalar accuracy = numeric::power_of_two<Scalar>(-digits / 2);
    const Coefficients p = powers(c);
    Scalar low = Scalar(0);
    Scalar high = Scalar(1);
    Scalar x = broken_line_root(c, direction);
    for (int i = 0; i < digits && low < x && x < high; ++i) {
      const Scalar value = (((p[4] * x + p[3]) * x + p[2]) * x + p[1]) * x + p[0];
      const Scalar slope =
          ((Scalar(4) * p[4] * x + Scalar(3) * p[3]) * x + Scalar(2) * p[2]) * x + p[1];
      const Scalar newton = x - value / slope;
      (direction * value > Scalar(0) ? low : high) = x;
      const bool inside = low < newton && newton < high;
      if (value == Scalar(0) || (inside && numeric::abs(newton - x) < accuracy)) {
        return value == Scalar(0) ? x : newton;
      }
      x = inside ? newton : numeric::half(low + high);
    }
    return x;
  }

  Scalar length_;
  Coefficients c_;
};

}  // namespace sonoglide::plant
