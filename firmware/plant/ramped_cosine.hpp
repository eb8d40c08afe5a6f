/// A cosine whose amplitude is linear in time, beside a force that is constant.
#pragma once

#include <array>
#include <cstddef>

#include "firmware/numeric/power_series.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/numeric/turn.hpp"
#include "firmware/plant/drive.hpp"

namespace sonoglide::plant {

/// Of the force (at_zero + slope phase) cos(phase) + bias, the phase in radians.
template <class Scalar>
struct LinearAmplitude {
  Scalar at_zero = Scalar(0);
  Scalar slope = Scalar(0);
  Scalar bias = Scalar(0);

  Scalar at(Scalar phase) const { return at_zero + slope * phase; }
};

/// No smaller than the force within a carrier period from phase 0 on.
template <class Scalar>
Scalar largest_force(const LinearAmplitude<Scalar>& amplitude) {
  constexpr Scalar turn = numeric::from_real<Scalar>(numeric::two_pi);
  return numeric::max(numeric::abs(amplitude.at_zero), numeric::abs(amplitude.at(turn))) +
         numeric::abs(amplitude.bias);
}

/// The force of a LinearAmplitude: an actuator that passes from one amplitude to the next along a
/// straight line, and one that adds a constant force to its carrier.
struct RampedCosineDrive {
  template <class Scalar>
  using Amplitude = LinearAmplitude<Scalar>;

  /// The drive at one phase. A time t later it is
  ///   value() + (in_phase' - quadrature) t + …,  in_phase and quadrature those of a CosineDrive of
  /// the amplitude at the phase, in_phase' and quadrature' those of its slope.
  template <class Scalar>
  struct Phasor {
    CosineDrive::Phasor<Scalar> level;  ///< (amplitude at the phase) cos(phase), sin(phase)
    CosineDrive::Phasor<Scalar> slope;  ///< (slope of the amplitude) cos(phase), sin(phase)
    Scalar bias;

    Phasor(const LinearAmplitude<Scalar>& amplitude, Scalar phase)
        : level(Scalar(1), phase), slope(level), bias(amplitude.bias) {
      level.in_phase *= amplitude.at(phase);
      level.quadrature *= amplitude.at(phase);
      slope.in_phase *= amplitude.slope;
      slope.quadrature *= amplitude.slope;
    }
    Scalar value() const { return level.in_phase + bias; }
    /// No smaller than n! times the n-th coefficient of the series in time, n at most 16.
    Scalar bound() const { return level.bound() + Scalar(16) * slope.bound() + numeric::abs(bias); }
  };

  /// Coefficients in t / unit about the phase, up to t^Order: those of the cosine, and those of
  /// slope t cos(phase + t) one power higher.
  template <class Scalar, std::size_t Order>
  class Series {
   public:
    Series(const Phasor<Scalar>& phasor, Scalar unit) {
      const CosineSeries level(phasor.level, unit);
      const CosineSeries slope(phasor.slope, unit);
      coefficients_[0] = level[0] + phasor.bias;
      for (std::size_t n = 1; n <= Order; ++n) {
        coefficients_[n] = level[n] + unit * slope[n - 1];
      }
    }
    Scalar operator[](std::size_t n) const { return coefficients_[n]; }
    /// The n-th coefficient, times a factor.
    Scalar term(std::size_t n, Scalar factor) const { return factor * coefficients_[n]; }
    Scalar at(Scalar x) const { return numeric::evaluate(coefficients_, x); }

   private:
    using CosineSeries = CosineDrive::Series<Scalar, Order>;

    std::array<Scalar, Order + 1> coefficients_;
  };

  /// By the rotation of a cosine of unit amplitude.
  template <class Scalar>
  class Samples {
   public:
    Samples(const LinearAmplitude<Scalar>& amplitude, Scalar phase, Scalar spacing)
        : amplitude_(amplitude),
          phase_(phase),
          spacing_(spacing),
          carrier_(Scalar(1), phase, spacing) {}
    Scalar value() const {
      return amplitude_.at(phase_ + count_ * spacing_) * carrier_.value() + amplitude_.bias;
    }
    void next() {
      carrier_.next();
      count_ += Scalar(1);
    }

   private:
    LinearAmplitude<Scalar> amplitude_;
    Scalar phase_;
    Scalar spacing_;
    Scalar count_ = Scalar(0);
    CosineDrive::Samples<Scalar> carrier_;
  };
};

}  // namespace sonoglide::plant
