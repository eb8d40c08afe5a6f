/// The place on a path that repeats itself.
#pragma once

#include <cstdint>

namespace sonoglide::app {

/// The place on a path that repeats itself after one period, from the sliding velocity of each step or from
/// the count of an encoder.
///
/// The distance is a whole number of counts: a step adds velocity code times weight, and the period
/// is P counts. Nothing is rounded, so the place has no drift: after any distance it is the sum of all
/// steps modulo P. What is left is the rounding of P itself, at most 2^-59 of a period in each period.
///
/// A step at full speed may be up to 8 periods long, so that a range of velocities far above the usual
/// ones stays within 64 bits.
class TexturePath {
 public:
  struct Parameters {
    std::int64_t period;    ///< P, above 2^58, at most 2^59 counts
    std::uint32_t inverse;  ///< 2^90 / P, rounded down
    /// From a sample to the middle of the effect of the answer to the next one, at full speed: in 2^-27
    /// periods of the path; at most 32 periods
    std::uint32_t lead;
  };

  /// Of an encoder.
  struct Encoder {
    std::int64_t count;  ///< counts of the path in one of its own; at most P / 8
    std::uint32_t most;  ///< of its counts at once, which are at most 2^61 of the path
  };

  explicit TexturePath(const Parameters& parameters) : parameters_(parameters) {}

  /// One step.
  /// @param velocity  code of the sliding velocity; below 0 the path is retraced
  /// @param weight    counts of a step with a code of 1; the step's length
  void advance(std::int32_t velocity, std::uint32_t weight) {
    distance_ += std::int64_t{velocity} * std::int64_t{weight};
    while (distance_ < 0) {
      distance_ += parameters_.period;
    }
    while (distance_ >= parameters_.period) {
      distance_ -= parameters_.period;
    }
  }

  /// The distance that an encoder has counted: exact whatever the number, in bounded time.
  /// @param counted  since the last step; below 0 the path is retraced
  /// @param encoder  that counts
  void advance_counted(std::int32_t counted, const Encoder& encoder) {
    const bool back = counted < 0;
    const std::uint32_t magnitude =
        back ? 0U - static_cast<std::uint32_t>(counted) : static_cast<std::uint32_t>(counted);
    const std::int64_t passed = modulo_period(magnitude, encoder);
    distance_ += back ? -passed : passed;
    if (distance_ < 0) {
      distance_ += parameters_.period;
    } else if (distance_ >= parameters_.period) {
      distance_ -= parameters_.period;
    }
  }

  /// The place in 2^-32 periods, rounded down.
  std::uint32_t turn() const {
    const auto part = static_cast<std::uint64_t>(distance_) >> 27U;
    return static_cast<std::uint32_t>((part * parameters_.inverse) >> 31U);
  }

  /// The place where the answer acts if the velocity stays as it is.
  /// @param velocity  as of advance()
  std::uint32_t turn_ahead(std::int32_t velocity) const {
    return turn_ahead(velocity, parameters_.lead);
  }
  /// @param velocity,lead  as of advance(); in place of the path's own
  std::uint32_t turn_ahead(std::int32_t velocity, std::uint32_t lead) const {
    const std::int64_t ahead = std::int64_t{velocity} * std::int64_t{lead};
    return turn() + static_cast<std::uint32_t>(static_cast<std::uint64_t>(ahead >> 26));
  }

  /// In counts, in [0, P).
  std::int64_t distance() const { return distance_; }
  void set_distance(std::int64_t distance) { distance_ = distance; }

 private:
  /// magnitude * count modulo P. After a jump of the count four digits at a time, from the highest: what is
  /// left of those before is below P, at most 2^59, and 16 of it below 2^63; 15 counts are below 2 P.
  std::int64_t modulo_period(std::uint32_t magnitude, const Encoder& encoder) const {
    if (magnitude <= encoder.most) {
      return subtract_periods(magnitude * encoder.count);
    }
    std::int64_t left = 0;
    for (int digit = 28; digit >= 0; digit -= 4) {
      left = subtract_periods(left * 16) +
             subtract_periods(std::int64_t{(magnitude >> digit) & 15U} * encoder.count);
      left = subtract_periods(left);
    }
    return left;
  }

  /// Of at most 16 periods the part of the last one: its binary digits above that are taken off.
  std::int64_t subtract_periods(std::int64_t distance) const {
    for (int digit = 3; digit >= 0; --digit) {
      const std::int64_t periods = parameters_.period << digit;
      distance -= distance >= periods ? periods : 0;
    }
    return distance;
  }

  const Parameters& parameters_;
  std::int64_t distance_ = 0;
};

/// A period of a path in counts of an encoder.
struct CountedPath {
  TexturePath::Parameters path;  ///< without a lead
  TexturePath::Encoder encoder;
};

/// At compile time: it takes double.
/// @param counts  of the encoder in a period, above 0 and below 2^59
constexpr CountedPath counted_path(double counts) {
  std::int64_t count = 1;
  for (; counts <= 0x1p58; counts *= 2.0) {
    count *= 2;
  }
  const auto period = static_cast<std::int64_t>(counts);
  // 2^90 / P, digit by digit: the first 58 of 2^90 hold no P.
  std::int64_t rest = std::int64_t{1} << 58;
  std::uint32_t inverse = 0;
  for (int digit = 0; digit < 32; ++digit) {
    rest *= 2;
    const bool one = rest >= period;
    rest -= one ? period : 0;
    inverse = 2 * inverse + (one ? 1U : 0U);
  }
  constexpr std::int64_t at_once = std::int64_t{1} << 61;
  const std::int64_t most = at_once / count < UINT32_MAX ? at_once / count : UINT32_MAX;
  return {{period, inverse, 0}, {count, static_cast<std::uint32_t>(most)}};
}

}  // namespace sonoglide::app
