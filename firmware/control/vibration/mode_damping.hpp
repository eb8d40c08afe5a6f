/// The feedback that damps a natural mode, whichever observer tells of it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware/control/interface/drive_command.hpp"
#include "firmware/control/interface/signals.hpp"
#include "firmware/control/vibration/pair.hpp"
#include "firmware/control/vibration/past_drive.hpp"
#include "firmware/control/vibration/vibration_part.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// The amplitude u comes to a steady one, u*, and damps the mode w on its way:
///   u' = u − K (w, u − u*), limited to [0, 1],
/// with the linear-quadratic gain K, u the latest command and w the mode at the phase 0 where the
/// answer acts, as the observer predicts it.
///
/// @tparam MaxDelay  largest delay, see PastDrive
/// @tparam Before    amplitudes before the sampled one that the observer asks for
template <class ScalarT, int MaxDelay, std::size_t Before, class ObserverT>
class ModeDamping : public VibrationPart<ScalarT> {
 public:
  using Scalar = ScalarT;
  using Requested = signal::RequestedVelocity;

  /// See Controller::settle_at.
  template <class Parameters>
  void settle_at(const Parameters& parameters) {
    observer_.settle_at(parameters.observer);
  }

  static constexpr Scalar highest(Scalar /*ceiling*/) { return largest(); }  // of a velocity

  /// The frequency stays that of the start.
  void after(const DriveCommand<Scalar>& command) { past_.append(command.amplitude); }

  /// No more of a drive would help.
  bool at_most() const { return at_most_; }

 protected:
  ModeDamping(const typename ObserverT::Parameters& observer, std::uint8_t delay)
      : observer_(observer), past_(delay) {}

  /// u* of a quarter of it, limited to 1. @param quarter  not below 0
  Scalar steady(Scalar quarter) {
    at_most_ = numeric::from_real<Scalar>(0.25) <= quarter;
    return at_most_ ? largest() : numeric::scale_by_power_of_two(quarter, 2);
  }

  /// u'. @param error  u − u*
  Scalar damped(Scalar error) const {
    const Scalar latest = past_.newest();
    return latest -
           numeric::clamp(observer_.feedback(predicted_mode(), error), latest - largest(), latest);
  }

  /// In the last period under way.
  Pair<Scalar> predicted_mode() const {
    Pair<Scalar> mode = observer_.mode();
    Scalar before = past_.sampled();
    for (std::size_t i = 0; i < past_.delay(); ++i) {
      mode = observer_.next(mode, past_.under_way(i) - before);
      before = past_.under_way(i);
    }
    return mode;
  }

  ObserverT observer_;
  PastDrive<Scalar, MaxDelay, Before> past_;
  bool at_most_ = false;

 private:
  static constexpr Scalar largest() { return numeric::from_code<Scalar>(INT32_MAX); }
};

}  // namespace sonoglide::control
