/// Calibration: the undriven friction force is learnt before the drive is first used.
#pragma once

#include <cstdint>

#include "firmware/numeric/accumulator.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// Mean magnitude of the undriven friction force over the last part of a calibration; the first
/// part lets the contact slide through its presliding travel and the sensor settle.
template <class Scalar>
class LearntFriction {
 public:
  struct Parameters {
    std::uint32_t settle_periods;         ///< samples passed over
    std::uint32_t average_periods;        ///< samples averaged, at least 1
    numeric::Accumulator<Scalar> weight;  ///< 1 / average_periods
  };

  explicit LearntFriction(const Parameters& parameters) : parameters_(parameters) {}

  void restart() {
    samples_ = 0;
    mean_ = {};
  }

  bool learning() const {
    return samples_ < parameters_.settle_periods + parameters_.average_periods;
  }

  /// Takes one undriven sample. Rounding of the mean: half a unit of the accumulator for each
  /// sample.
  void learn(Scalar force) {
    if (samples_ >= parameters_.settle_periods) {
      mean_ += numeric::accumulate(numeric::abs(force)) * parameters_.weight;
    }
    ++samples_;
  }

  Scalar friction_force(Scalar /*configured*/) const { return numeric::rounded<Scalar>(mean_); }

 private:
  Parameters parameters_;
  std::uint32_t samples_ = 0;
  numeric::Accumulator<Scalar> mean_{};
};

}  // namespace sonoglide::control
