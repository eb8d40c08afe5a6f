/// Drive waveforms. Each offers itself in two forms: as a power series about one phase, and sampled
/// at equal steps of phase.
#pragma once

#include <array>
#include <cstddef>

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/plant/polynomial.hpp"

namespace sonoglide::plant {

struct NoDrive {
  template <class Scalar>
  struct Phasor {
    Phasor(Scalar /*amplitude*/, Scalar /*phase*/) {}
    Scalar value() const { return Scalar(0); }
    Scalar bound() const { return Scalar(0); }
  };

  template <class Scalar, std::size_t Order>
  struct Series {
    Series(const Phasor<Scalar>& /*phasor*/, Scalar /*unit*/) {}
    Scalar operator[](std::size_t /*n*/) const { return Scalar(0); }
    static constexpr std::size_t size() { return 1; }
  };

  template <class Scalar>
  struct Samples {
    Samples(Scalar /*amplitude*/, Scalar /*phase*/, Scalar /*spacing*/) {}
    Scalar value() const { return Scalar(0); }
    void next() {}
  };
};

/// a cos(phase), the phase in radians.
struct CosineDrive {
  /// The drive at one phase.
  template <class Scalar>
  struct Phasor {
    Scalar in_phase;    ///< a cos(phase)
    Scalar quadrature;  ///< a sin(phase)

    Phasor(Scalar amplitude, Scalar phase)
        : in_phase(amplitude * numeric::cos(phase)), quadrature(amplitude * numeric::sin(phase)) {}
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
      const Scalar unit_squared = unit * unit;
      for (std::size_t n = 2; n <= Order; ++n) {
        coefficients_[n] = -coefficients_[n - 2] * unit_squared *
                           (reciprocal<Scalar>(n) * reciprocal<Scalar>(n - 1));
      }
    }
    Scalar operator[](std::size_t n) const { return coefficients_[n]; }
    static constexpr std::size_t size() { return Order + 1; }

   private:
    std::array<Scalar, Order + 1> coefficients_;
  };

  /// One rotation for each sample instead of one cosine; the error grows by a rounding each time.
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

}  // namespace sonoglide::plant
