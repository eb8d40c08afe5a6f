/// Drive waveforms. Each offers the type of its amplitude, a power series about one phase, and samples
/// at equal steps of phase. A waveform with corners or jumps consists of straight pieces; an interval lies within one
/// piece.
#pragma once

#include <array>
#include <cstddef>

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/power_series.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::plant {

/// No smaller than the force of a drive.
template <class Scalar>
Scalar largest_force(Scalar amplitude) {
  return numeric::abs(amplitude);
}

/// No drive force.
struct NoDrive {
  template <class Scalar>
  using Amplitude = Scalar;

  /// The zero to subtract from at no cost: -0 - x is -x to a compiler, 0 - x is not.
  template <class Scalar>
  static constexpr Scalar nothing = numeric::from_real<Scalar>(-0.0);

  template <class Scalar>
  struct Phasor {
    Phasor(Scalar /*amplitude*/, Scalar /*phase*/) {}
    Scalar value() const { return nothing<Scalar>; }
    Scalar bound() const { return Scalar(0); }
  };

  template <class Scalar, std::size_t Order>
  struct Series {
    Series(const Phasor<Scalar>& /*phasor*/, Scalar /*unit*/) {}
    Scalar operator[](std::size_t /*n*/) const { return nothing<Scalar>; }
    Scalar term(std::size_t /*n*/, Scalar /*factor*/) const { return nothing<Scalar>; }
    Scalar at(Scalar /*x*/) const { return Scalar(0); }
  };

  template <class Scalar>
  struct Samples {
    Samples(Scalar /*amplitude*/, Scalar /*phase*/, Scalar /*spacing*/) {}
    Scalar value() const { return nothing<Scalar>; }
    void next() {}
  };
};

/// a cos(phase), the phase in radians.
struct CosineDrive {
  template <class Scalar>
  using Amplitude = Scalar;

  /// The drive at one phase.
  template <class Scalar>
  struct Phasor {
    Scalar in_phase;    ///< a cos(phase)
    Scalar quadrature;  ///< a sin(phase)

    Phasor(Scalar amplitude, Scalar phase) {
      const auto angle = numeric::sine_and_cosine(phase);
      in_phase = amplitude * angle.cosine;
      quadrature = amplitude * angle.sine;
    }
    Scalar value() const { return in_phase; }
    /// No smaller than the amplitude.
    Scalar bound() const { return numeric::abs(in_phase) + numeric::abs(quadrature); }
  };

  /// Coefficients in t / unit about the phase, up to t^Order.
  template <class Scalar, std::size_t Order>
  class Series {
   public:
    Series(const Phasor<Scalar>& phasor, Scalar unit) {
      coefficients_[0] = phasor.in_phase;
      coefficients_[1] = -phasor.quadrature * unit;
      const Scalar minus_square = -(unit * unit);
      for (std::size_t n = 2; n <= Order; ++n) {
        // The phase enters late: it waits for one product each.
        coefficients_[n] =
            coefficients_[n - 2] *
            (minus_square * (numeric::reciprocal<Scalar>(n) * numeric::reciprocal<Scalar>(n - 1)));
      }
    }
    Scalar operator[](std::size_t n) const { return coefficients_[n]; }
    /// The n-th coefficient, times a factor.
    Scalar term(std::size_t n, Scalar factor) const { return factor * coefficients_[n]; }
    Scalar at(Scalar x) const { return numeric::evaluate(coefficients_, x); }

   private:
    std::array<Scalar, Order + 1> coefficients_;
  };

  /// Samples by one rotation each in place of one cosine; the error grows by a rounding each time.
  template <class Scalar>
  class Samples {
   public:
    Samples(Scalar amplitude, Scalar phase, Scalar spacing)
        : phasor_(amplitude, phase), step_(Scalar(1), spacing) {}
    Scalar value() const { return phasor_.in_phase; }
    void next() {
      const Scalar in_phase =
          phasor_.in_phase * step_.in_phase - phasor_.quadrature * step_.quadrature;
      phasor_.quadrature =
          phasor_.quadrature * step_.in_phase + phasor_.in_phase * step_.quadrature;
      phasor_.in_phase = in_phase;
    }

   private:
    Phasor<Scalar> phasor_;
    Phasor<Scalar> step_;
  };
};

/// at_zero + slope phase, the phase in radians.
template <class Scalar>
struct StraightForce {
  Scalar at_zero = Scalar(0);
  Scalar slope = Scalar(0);

  Scalar at(Scalar phase) const { return at_zero + slope * phase; }
};

/// A piece of a square wave, a triangle or a sawtooth: the force is linear in time.
struct StraightDrive {
  template <class Scalar>
  using Amplitude = StraightForce<Scalar>;

  /// The drive at one phase.
  template <class Scalar>
  struct Phasor {
    Scalar force;
    Scalar slope;

    Phasor(const StraightForce<Scalar>& amplitude, Scalar phase)
        : force(amplitude.at(phase)), slope(amplitude.slope) {}
    Scalar value() const { return force; }
    Scalar bound() const { return numeric::abs(force) + numeric::abs(slope); }
  };

  /// Coefficients in t / unit about the phase.
  template <class Scalar, std::size_t Order>
  class Series {
   public:
    Series(const Phasor<Scalar>& phasor, Scalar unit)
        : coefficients_{phasor.force, phasor.slope * unit} {}
    Scalar operator[](std::size_t n) const { return n < 2 ? coefficients_[n] : Scalar(0); }
    /// The n-th coefficient, times a factor.
    Scalar term(std::size_t n, Scalar factor) const {
      return n < 2 ? factor * coefficients_[n] : NoDrive::nothing<Scalar>;
    }
    Scalar at(Scalar x) const { return coefficients_[0] + x * coefficients_[1]; }

   private:
    std::array<Scalar, 2> coefficients_;
  };

  template <class Scalar>
  class Samples {
   public:
    Samples(const StraightForce<Scalar>& amplitude, Scalar phase, Scalar spacing)
        : amplitude_(amplitude), phase_(phase), spacing_(spacing) {}
    Scalar value() const { return amplitude_.at(phase_ + count_ * spacing_); }
    void next() { count_ += Scalar(1); }

   private:
    StraightForce<Scalar> amplitude_;
    Scalar phase_;
    Scalar spacing_;
    Scalar count_ = Scalar(0);
  };
};

}  // namespace sonoglide::plant
