/// The inverse map where its arguments mostly stay as they are.
#pragma once

namespace sonoglide::control {

/// Evaluates the map each time: measured ratios move the commanded one all the time.
template <class FeedforwardT>
class EvaluatedMap {
 public:
  using Scalar = typename FeedforwardT::Scalar;

  static constexpr void forget() {}
  static Scalar amplitude(const FeedforwardT& feedforward, Scalar half_ratio, Scalar speed) {
    return feedforward.amplitude(half_ratio, speed);
  }
};

/// Evaluates the map where the ratio or the speed is another than in the last step. Without a force
/// sensor the ratio is the target, and a steady speed has a steady code.
template <class FeedforwardT>
class RememberedMap {
 public:
  using Scalar = typename FeedforwardT::Scalar;

  /// The map is another from here on.
  void forget() { speed_ = {}; }

  /// @param feedforward  the map
  /// @param half_ratio   friction ratio on base 2
  /// @param speed        > 0
  Scalar amplitude(const FeedforwardT& feedforward, Scalar half_ratio, Scalar speed) {
    if (speed != speed_ || half_ratio != half_ratio_) {
      half_ratio_ = half_ratio;
      speed_ = speed;
      amplitude_ = feedforward.amplitude(half_ratio, speed);
    }
    return amplitude_;
  }

 private:
  Scalar half_ratio_{};
  Scalar speed_{};  ///< 0: nothing is remembered
  Scalar amplitude_{};
};

}  // namespace sonoglide::control
