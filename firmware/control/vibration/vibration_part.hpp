/// How the drive acts on the vibration: what every mode offers.
#pragma once

#include "firmware/control/interface/drive_command.hpp"

namespace sonoglide::control {

/// What a mode of the vibration does where it has nothing of its own to do. In each carrier period
/// the controller calls before(), observe(), with a force sensor sense(), then drive() and after();
/// those that a mode leaves empty cost nothing.
template <class ScalarT>
class VibrationPart {
 public:
  using Scalar = ScalarT;
  static constexpr bool observed = false;  ///< a sensor of its own tells of the vibration
  /// That the controller names where the drive stands at its largest.
  static constexpr Limit at_full_drive = Limit::actuator;

  /// See Controller::settle_at.
  template <class Parameters>
  static constexpr void settle_at(const Parameters& /*parameters*/) {}

  /// rested: the drive has been at zero for long.
  static constexpr void restart(bool /*rested*/) {}

  /// The target is another. change: in friction ratio, on base 2.
  static constexpr void retarget(Scalar /*change*/) {}

  /// One call for each period, before its sample.
  static constexpr void before() {}

  /// Takes a sample of usable numbers.
  template <class Sample>
  static constexpr Fault observe(const Sample& /*sample*/) {
    return Fault::none;
  }

  /// Takes a reading of the friction. measured: friction ratio on base 2; speed: |Vt| of the sample.
  template <class Feedforward>
  static constexpr void sense(Scalar /*measured*/, Scalar /*speed*/, bool /*backwards*/,
                              const Feedforward& /*feedforward*/) {}

  /// The velocity or amplitude that may be asked for at most. @param ceiling  of the drive
  static constexpr Scalar highest(Scalar ceiling) { return ceiling; }

  /// Nothing but a limit keeps the drive from what was last asked for.
  static constexpr bool settled() { return true; }

  /// No more of a drive would help.
  static constexpr bool at_most() { return false; }

  /// The friction ratio that the drive stands for. by_velocity: that of a vibration velocity.
  template <class OfVelocity>
  static constexpr Scalar implied_ratio(Scalar commanded, const OfVelocity& /*by_velocity*/) {
    return commanded;
  }

  /// What DriveCommand::commanded_ratio tells.
  static constexpr Scalar reported_ratio(Scalar commanded) { return commanded; }

  /// One call for each step, with its answer, before after(). friction() is the mean friction force that is
  /// expected, with the sign of a sample.
  template <class Friction>
  static constexpr void balance(const DriveCommand<Scalar>& /*command*/,
                                const Friction& /*friction*/) {}

  /// One call for each step, with its answer, to which a mode may add.
  static constexpr void after(const DriveCommand<Scalar>& /*command*/) {}
};

}  // namespace sonoglide::control
