/// A target that varies along the sliding distance, compiled in.
#pragma once

#include <cstdint>
#include <type_traits>

#include "firmware/app/texture_path.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/scalar.hpp"
#include "hal/board.hpp"

namespace sonoglide::app {

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
