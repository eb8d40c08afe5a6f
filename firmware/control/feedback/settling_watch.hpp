/// Whether the measured friction ratio reaches its target, and what it shows of the friction force.
#pragma once

#include <cstdint>

#include "firmware/control/interface/drive_command.hpp"
#include "firmware/control/interface/ratio.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// Counts the periods in which the measured ratio is outside target ± band: 4 up for each of these,
/// 1 down for each period inside. From 4·patience on the loop is not settling. So a ratio that is
/// outside for more than a fifth of the time is found, whether it stays away or swings through the
/// band. 129 periods inside in a row end the limit. Back at zero the loop has settled. All ratios
/// on base 2.
///
/// In a settled loop the commanded ratio is the true one, as far as the friction-ratio map is
/// right, and the target is what the nominal friction force makes of it: commanded / target =
/// nominal / true force. The mismatch counts once 16 more periods show it than do not.
template <class Scalar>
class SettlingWatch {
 public:
  struct Parameters {
    Scalar band;             ///< half width, > 0
    std::uint16_t patience;  ///< periods outside the band that are granted, >= 1
    Scalar agreement;        ///< least true / nominal friction, or its inverse, not warned of

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("band", self.band);
      visit("patience", self.patience);
      visit("agreement", self.agreement);
    }
  };

  explicit SettlingWatch(const Parameters& parameters) : parameters_(parameters) {}

  void restart() {
    count_ = 1;  // pending until a period is inside
    above_ = below_ = clamped_ = false;
    disagreement_ = 0;
  }

  /// Another target: at least half of the patience is left for it.
  void retarget() { count_ = count_ < limit() / 2 ? count_ : limit() / 2; }

  /// The friction force is another from here on.
  void forget_disagreement() { disagreement_ = 0; }

  /// One call for each period in which the drive is to hold a ratio.
  /// @param target     ratio
  /// @param measured   ratio
  /// @param commanded  ratio that the drive is picked for
  /// @param clamped    the command stands at an end of its range
  void judge(Scalar target, Scalar measured, Scalar commanded, bool clamped) {
    const Scalar error = numeric::kept_difference(measured, target);
    if (numeric::kept_of(parameters_.band) < numeric::abs(error)) {
      if (count_ <= limit() / 2) {
        above_ = below_ = clamped_ = false;
      }
      count_ = count_ + step < limit() ? count_ + step : limit() + afterwards;
      above_ = above_ || Scalar{} < error;
      below_ = below_ || error < Scalar{};
      clamped_ = clamped_ || clamped;
    } else if (count_ > 0) {
      --count_;
      count_ = count_ + 1 == limit() ? 0 : count_;
    }
    const bool disagrees =
        commanded < target ? commanded < numeric::bounded_product(parameters_.agreement, target)
                           : target < numeric::bounded_product(parameters_.agreement, commanded);
    if (disagrees) {
      disagreement_ += disagreement_ < 2 * disagreement_named ? 1 : 0;
    } else {
      disagreement_ -= disagreement_ > 0 ? 1 : 0;
    }
  }

  /// The target, or 0 where a velocity is another than a ratio that agrees with the target would need.
  /// @param target       friction ratio
  /// @param requested    velocity that the target needs
  /// @param velocity     that the steady amplitude holds
  /// @param velocity_of  that a ratio needs
  template <class VelocityOf>
  Scalar implied_ratio(Scalar target, Scalar requested, Scalar velocity,
                       const VelocityOf& velocity_of) const {
    if (requested < velocity) {
      return velocity_of(parameters_.agreement * target) < velocity ? Scalar{} : target;
    }
    if (target < whole_ratio<Scalar> * parameters_.agreement) {
      // The quotient rounds: a target just below would come out above 1.
      const Scalar agreeing = numeric::min(
          numeric::twice(numeric::half(target) / parameters_.agreement), whole_ratio<Scalar>);
      return velocity < velocity_of(agreeing) ? Scalar{} : target;
    }
    return target;
  }

  Settling settling() const {
    if (count_ == 0) {
      return Settling::settled;
    }
    if (count_ < limit()) {
      return Settling::pending;
    }
    if (clamped_) {
      return Settling::clamped;
    }
    return above_ && below_ ? Settling::ringing : Settling::offset;
  }

  /// none, mismatch or not_settling.
  Limit limit_named() const {
    if (count_ == 0) {
      return disagreement_ >= disagreement_named ? Limit::mismatch : Limit::none;
    }
    return count_ < limit() ? Limit::none : Limit::not_settling;
  }

  /// A limit is named, or the ratio has been outside of its band for more than two periods of late.
  bool doubts() const { return 2 * step < count_ || limit_named() != Limit::none; }

 private:
  static constexpr std::uint32_t step = 4;
  static constexpr int disagreement_named = 16;     ///< noise alone is not named
  static constexpr std::uint32_t afterwards = 128;  ///< periods inside that end the limit

  std::uint32_t limit() const { return step * parameters_.patience; }

  Parameters parameters_;
  std::uint32_t count_ = 1;
  bool above_ = false;
  bool below_ = false;
  bool clamped_ = false;
  int disagreement_ = 0;  ///< up where command and target disagree, down where they agree
};

}  // namespace sonoglide::control
