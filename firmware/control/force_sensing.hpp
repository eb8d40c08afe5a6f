/// Whether a sensor tells the friction force.
#pragma once

#include "firmware/control/interface/drive_command.hpp"
#include "firmware/control/interface/part_name.hpp"

namespace sonoglide::control {

/// In place of a part that judges readings of the friction force.
struct NothingToJudge {
  struct Parameters {};

  explicit NothingToJudge(const Parameters&) {}
  static constexpr void restart() {}
  static constexpr void retarget() {}
  template <class Scalar>
  static constexpr void judge(Scalar /*target*/, Scalar /*measured*/, Scalar /*commanded*/,
                              bool /*clamped*/) {}
  template <class Scalar, class VelocityOf>
  static constexpr Scalar implied_ratio(Scalar target, Scalar /*requested*/, Scalar /*velocity*/,
                                        const VelocityOf& /*velocity_of*/) {
    return target;
  }
  static constexpr Limit limit_named() { return Limit::none; }
  static constexpr Settling settling() { return Settling::pending; }
};

struct ForceSensor {
  static constexpr PartName part_name{"force_sensing", "ForceSensor"};
  struct Parameters {};
  static constexpr bool present = true;
  template <class Part>
  using Judge = Part;
};

/// The ratio rests on the vibration and on the friction that the controller believes.
struct NoForceSensor {
  static constexpr PartName part_name{"force_sensing", "NoForceSensor"};
  struct Parameters {};
  static constexpr bool present = false;
  template <class Part>
  using Judge = NothingToJudge;
};

}  // namespace sonoglide::control
