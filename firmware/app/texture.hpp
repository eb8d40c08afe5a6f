/// A target that varies along the sliding distance, compiled in.
#pragma once

#include <cstdint>
#include <type_traits>

#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/scalar.hpp"
#include "hal/board.hpp"

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
///
/// @tparam Period  has its length: static constexpr double period_m
template <class ScalarT, class StepsT, class Period>
struct TextureTargets {
  using Scalar = ScalarT;
  using Steps = StepsT;
  using Length = Period;

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

/// The distance along a texture as the controller integrates it from the sliding velocity. It begins at 0.
template <class Targets>
class IntegratedDistance {
 public:
  explicit IntegratedDistance(const Targets& targets)
      : steps_(targets.steps), path_(targets.path) {}

  /// To the time of the last sample.
  /// @param controller  of the steps
  template <class Controller>
  void advance(const Controller& controller) {
    path_.advance(velocity_, steps_.weight_of(controller, rest_));
  }

  /// Takes the sliding velocity of a sample. One that is missing leaves the last one in force.
  template <class Board>
  void pass(const hal::Sample& sample, Board& /*board*/) {
    if (sample.fresh) {
      velocity_ = sample.sliding_velocity;
    }
  }

  std::uint32_t turn_ahead() const { return path_.turn_ahead(velocity_); }

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
  const typename Targets::Steps& steps_;
  TexturePath path_;
  std::int32_t velocity_ = 0;  ///< of the last sample
  std::uint32_t rest_ = 0;     ///< see WordedSteps
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

/// The distance along a texture as its board counts it (see hal/board.hpp): no velocity is integrated, and
/// a sample that is missing leaves nothing out. It is 0 where the count of the board is.
template <class Targets, class Board>
class CountedDistance {
  static constexpr double counts = Targets::Length::period_m * Board::travel_counts_per_m;
  static_assert(
      counts >= 8.0 && counts <= 0x1p30,
      "controller.target_texture: the encoder of this board counts too little or too much "
      "of a period_m; allowed: 8 to 2^30 counts");
  static constexpr CountedPath counted = counted_path(counts);

 public:
  explicit CountedDistance(const Targets& targets)
      : lead_(targets.path.lead), path_(counted.path) {}

  /// See IntegratedDistance.
  template <class Controller>
  void advance(const Controller& /*controller*/) {
    path_.advance_counted(static_cast<std::int32_t>(count_ - passed_), counted.encoder);
    passed_ = count_;
  }

  /// Takes the count that belongs to a sample; from the velocity the place ahead.
  void pass(const hal::Sample& sample, Board& board) {
    count_ = board.travel();
    if (sample.fresh) {
      velocity_ = sample.sliding_velocity;
    }
  }

  std::uint32_t turn_ahead() const { return path_.turn_ahead(velocity_, lead_); }

 private:
  std::uint32_t lead_;
  TexturePath path_;
  std::int32_t velocity_ = 0;  ///< of the last sample
  std::uint32_t count_ = 0;    ///< of the board with the last sample
  std::uint32_t passed_ = 0;   ///< up to which the path is advanced
};

/// Follows a texture, one call of each function for each step.
///
/// @tparam Distance  IntegratedDistance or CountedDistance
template <class Targets, class Distance>
class TextureSchedule {
 public:
  explicit TextureSchedule(const Targets& targets) : targets_(targets), distance_(targets) {}

  /// The target of the step whose sample comes next.
  /// @param controller  of the steps
  template <class Controller>
  typename Targets::Scalar next(const Controller& controller) {
    distance_.advance(controller);
    return targets_.at(distance_.turn_ahead());
  }

  /// Sets it.
  template <class Controller>
  void advance(Controller& controller) {
    controller.set_target(next(controller));
  }

  /// Takes a sample and, where the board counts the distance, what it has counted.
  template <class Board>
  void pass(const hal::Sample& sample, Board& board) {
    distance_.pass(sample, board);
  }

  /// All that it goes on from.
  auto state() const { return distance_.state(); }
  template <class State>
  void set_state(const State& state) {
    distance_.set_state(state);
  }

 private:
  const Targets& targets_;
  Distance distance_;
};

/// @tparam Board  whose count is the distance if it has one; void: none has
template <class Board = void, class Scalar, class Steps, class Period>
auto schedule_of(const TextureTargets<Scalar, Steps, Period>& targets) {
  using Targets = TextureTargets<Scalar, Steps, Period>;
  using Distance = std::conditional_t<hal::counts_travel<Board>, CountedDistance<Targets, Board>,
                                      IntegratedDistance<Targets>>;
  return TextureSchedule<Targets, Distance>(targets);
}

// ---- In a unit ----

/// Of a unit with a texture: an order of 0, which no texture holds, is to follow it.
template <class Scalar, class Steps, class Period>
constexpr Scalar first_target(const TextureTargets<Scalar, Steps, Period>& /*targets*/) {
  return Scalar{};
}

/// The place on the texture moves with every sample, whatever the unit does: so a ridge stays where it is
/// through stops, faults and other targets. See OrderedTargets.
template <class Schedule, class Scalar>
class TextureCourse {
 public:
  explicit TextureCourse(const Schedule& schedule) : schedule_(schedule) {}

  template <class Controller>
  void move(const Controller& controller) {
    target_ = schedule_.next(controller);
  }
  template <class Board>
  void pass(const hal::Sample& sample, Board& board) {
    schedule_.pass(sample, board);
  }
  template <class Controller>
  void aim(Controller& controller) const {
    if (follows_) {
      controller.set_target(target_);
    }
  }
  bool takes(Scalar ordered) {
    follows_ = ordered == Scalar{};
    return follows_;
  }

 private:
  Schedule schedule_;
  Scalar target_{};
  bool follows_ = true;
};

template <class Board, class Scalar, class Steps, class Period>
auto course_of(const TextureTargets<Scalar, Steps, Period>& targets) {
  const auto schedule = schedule_of<Board>(targets);
  return TextureCourse<std::decay_t<decltype(schedule)>, Scalar>(schedule);
}

}  // namespace sonoglide::app
