/// A target that varies along the sliding distance, compiled in.
#pragma once

#include <cstdint>

#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/scalar.hpp"
#include "hal/board.hpp"

namespace sonoglide::app {

/// The place on a path that repeats itself after one period, from the sliding velocity of each step.
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

  /// The place in 2^-32 periods, rounded down.
  std::uint32_t turn() const {
    const auto part = static_cast<std::uint64_t>(distance_) >> 27U;
    return static_cast<std::uint32_t>((part * parameters_.inverse) >> 31U);
  }

  /// The place where the answer acts if the velocity stays as it is.
  /// @param velocity  as of advance()
  std::uint32_t turn_ahead(std::int32_t velocity) const {
    const std::int64_t ahead = std::int64_t{velocity} * std::int64_t{parameters_.lead};
    return turn() + static_cast<std::uint32_t>(static_cast<std::uint64_t>(ahead >> 26));
  }

  /// In counts, in [0, P).
  std::int64_t distance() const { return distance_; }
  void set_distance(std::int64_t distance) { distance_ = distance; }

 private:
  const Parameters& parameters_;
  std::int64_t distance_ = 0;
};

/// Steps of one length.
struct EqualSteps {
  std::uint32_t weight;  ///< see TexturePath::advance

  template <class Controller>
  std::uint32_t weight_of(const Controller& /*controller*/, std::uint32_t& /*rest*/) const {
    return weight;
  }
};

/// Steps of a drive whose frequency is a word: each is as long as the word of the start is over its
/// own. What its weight is rounded down by goes to the next one.
struct WordedSteps {
  std::uint32_t weight;      ///< of a step at the start; below 2^31
  std::uint32_t start_word;  ///< frequency of the start in steps of the word; below 2^31

  /// @param controller,rest  that leads the frequency; left of the last step, becomes that of this one
  template <class Controller>
  std::uint32_t weight_of(const Controller& controller, std::uint32_t& rest) const {
    const auto word =
        static_cast<std::uint64_t>(std::int64_t{start_word} + controller.next_frequency());
    const std::uint64_t whole = std::uint64_t{start_word} * weight + rest;
    rest = static_cast<std::uint32_t>(whole % word);
    return static_cast<std::uint32_t>(whole / word);
  }
};

/// Targets at equal distances along one period of a path, the first at its beginning; linear between
/// them, and from the last to the first of the next period.
template <class Scalar, class Steps>
struct TextureTargets {
  Steps steps;
  TexturePath::Parameters path;
  const Scalar* points;  ///< see Controller::set_target; all of one sign
  std::uint16_t count;   ///< of the points, at least 2

  /// @param turn  the place in 2^-32 periods
  Scalar at(std::uint32_t turn) const {
    const std::uint64_t place = std::uint64_t{turn} * count;
    const auto before = static_cast<std::uint32_t>(place >> 32U);
    const std::uint32_t after = before + 1 < count ? before + 1 : 0;
    const auto part =
        numeric::from_code<Scalar>(static_cast<std::int32_t>((place >> 1U) & INT32_MAX));
    return points[before] + numeric::rough_product(part, points[after] - points[before]);
  }
};

/// Units are told their targets by a host: they have no texture, and no first target.
template <class Scalar, class Steps>
void first_target(const TextureTargets<Scalar, Steps>& targets) = delete;

/// Follows a texture, one call of each function for each step.
template <class Scalar, class Steps>
class TextureSchedule {
 public:
  explicit TextureSchedule(const TextureTargets<Scalar, Steps>& targets)
      : targets_(targets), path_(targets.path) {}

  /// Sets the target of the step whose sample comes next.
  template <class Controller>
  void advance(Controller& controller) {
    path_.advance(velocity_, targets_.steps.weight_of(controller, rest_));
    controller.set_target(targets_.at(path_.turn_ahead(velocity_)));
  }

  /// Takes the sliding velocity of a sample. One that is missing leaves the last one in force.
  void pass(const hal::Sample& sample) {
    if (sample.fresh) {
      velocity_ = sample.sliding_velocity;
    }
  }

  /// All that it goes on from.
  struct State {
    std::int64_t distance;
    std::int32_t velocity;
    std::uint32_t rest;
  };
  State state() const { return {path_.distance(), velocity_, rest_}; }
  void set_state(const State& state) {
    path_.set_distance(state.distance);
    velocity_ = state.velocity;
    rest_ = state.rest;
  }

 private:
  const TextureTargets<Scalar, Steps>& targets_;
  TexturePath path_;
  std::int32_t velocity_ = 0;  ///< of the last sample
  std::uint32_t rest_ = 0;     ///< see WordedSteps
};

template <class Scalar, class Steps>
TextureSchedule<Scalar, Steps> schedule_of(const TextureTargets<Scalar, Steps>& targets) {
  return TextureSchedule<Scalar, Steps>(targets);
}

}  // namespace sonoglide::app
