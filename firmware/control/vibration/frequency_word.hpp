/// The drive's frequency as its synthesiser takes it: a whole number of steps.
#pragma once

#include <cstdint>

#include "firmware/numeric/fixed.hpp"
#include "firmware/numeric/floating.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// Counts steps from the frequency of the start. A frequency is told by its deviation from that,
/// relative to it, on base 1/8.
///
/// The word stays as it is until the wanted frequency is 3/4 of a step away. So noise does not make
/// it change between two neighbours all the time.
template <class Scalar>
class FrequencyWord {
 public:
  struct Parameters {
    numeric::Split<Scalar> steps;      ///< in a deviation of 1, at most 2^25
    numeric::Split<Scalar> deviation;  ///< of one step

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("steps", self.steps);
      visit("deviation", self.deviation);
    }
  };

  explicit FrequencyWord(const Parameters& parameters)
      : fine_steps_(numeric::rescaled(numeric::floating(parameters.steps), fine_bits)),
        deviation_(numeric::floating(parameters.deviation)) {}

  /// Back to the start.
  void restart() { count_ = 0; }

  /// Steps from the start.
  std::int32_t steps() const { return count_; }

  /// Takes the nearest word to a wanted deviation, in [-1, 1].
  /// @return its own deviation; in fixed point too small by less than a unit of the last place
  Scalar approach(Scalar wanted) {
    const std::int32_t fine = fine_steps(wanted);
    const std::int32_t away = fine - count_ * unit;
    constexpr std::int32_t hysteresis = 3 * unit / 4;
    if (away >= hysteresis || -away >= hysteresis) {
      count_ = (fine + unit / 2) >> fine_bits;
    }
    return deviation();
  }

 private:
  static constexpr int fine_bits = 5;
  static constexpr std::int32_t unit = std::int32_t{1} << fine_bits;

  /// In 1/32 of a step; what is left of one is cut off.
  std::int32_t fine_steps(Scalar wanted) const {
    if constexpr (numeric::is_fixed_point_v<Scalar>) {
      constexpr int bits = 2 * Scalar::fraction_bits;
      const std::int64_t product = std::int64_t{wanted.raw()} * fine_steps_.mantissa.raw();
      return static_cast<std::int32_t>(product >> (bits - fine_steps_.exponent));
    } else {
      return static_cast<std::int32_t>(wanted * fine_steps_);
    }
  }

  Scalar deviation() const {
    if constexpr (numeric::is_fixed_point_v<Scalar>) {
      const std::int64_t product = std::int64_t{count_} * deviation_.mantissa.raw();
      return Scalar::from_raw(static_cast<typename Scalar::Raw>(product >> -deviation_.exponent));
    } else {
      return static_cast<Scalar>(count_) * deviation_;
    }
  }

  numeric::Floating<Scalar> fine_steps_;
  numeric::Floating<Scalar> deviation_;
  std::int32_t count_ = 0;
};

}  // namespace sonoglide::control
