/// What a controller is made of, and the numbers that it works with.
#pragma once

#include <type_traits>

#include "firmware/control/feedback/settling_watch.hpp"
#include "firmware/control/force_sensing.hpp"
#include "firmware/control/friction/friction_level.hpp"
#include "firmware/control/friction/periodic_relearning.hpp"
#include "firmware/control/friction/remembered_map.hpp"
#include "firmware/control/friction/speed_foresight.hpp"
#include "firmware/control/limits/drive_limit.hpp"
#include "firmware/control/limits/plausibility.hpp"
#include "firmware/control/limits/sample_inspection.hpp"
#include "firmware/control/limits/standstill_hold.hpp"
#include "firmware/control/limits/stuck_detector.hpp"
#include "firmware/control/target.hpp"
#include "firmware/control/vibration/fed_forward.hpp"

namespace sonoglide::control {

/// The parts of a controller; each is a type. What a part does not do costs nothing.
///
/// The Parameters of a part, where they are not empty, name their fields:
/// Parameters::fields(parameters, visit) calls visit(name, field) for each, in order.
template <class ScalarT, class FrictionT, class FeedforwardT, class SlewT, class ShaperT,
          class RegulatorT, class RelearningT = NoRelearning<ScalarT>,
          class VibrationT = FedForward<ScalarT>, class ForceT = ForceSensor,
          class TargetT = RatioTarget<ScalarT>, class CeilingT = FullDrive<ScalarT>,
          class SamplesT = StrictSamples>
struct Parts {
  using Scalar = ScalarT;
  using Friction = FrictionT;        ///< TrustedFriction | LearntFriction
  using Feedforward = FeedforwardT;  ///< CoulombFeedforward | (Tracked)DahlFeedforward |
                                     ///< TabulatedFeedforward
  using Slew = SlewT;                ///< NoSlewLimit | SlewLimit
  using Shaper = ShaperT;            ///< NoShaping | NotchShaper
  using Regulator = RegulatorT;      ///< NoFeedback | IntegralRegulator | ScalingRegulator |
                                     ///< AdaptiveRegulator
  using Relearning = RelearningT;    ///< NoRelearning | PeriodicRelearning | FrictionTracking
  using Vibration =
      VibrationT;        ///< FedForward | SensorlessVibration | DampedVibration | ResonantVibration
  using Force = ForceT;  ///< ForceSensor | NoForceSensor
  using Target = TargetT;    ///< RatioTarget | ForceTarget
  using Ceiling = CeilingT;  ///< FullDrive | DriveLimit
  using Samples = SamplesT;  ///< StrictSamples | TolerantSamples

  using Stuck = typename Force::template Judge<StuckDetector<Scalar>>;
  using Plausible = typename Force::template Judge<Plausibility<Scalar>>;
  using Watch = typename Force::template Judge<SettlingWatch<Scalar>>;
  // Measured ratios move the commanded one all the time.
  using Map =
      std::conditional_t<Force::present, EvaluatedMap<Feedforward>, RememberedMap<Feedforward>>;

  // A vibration is foreseen from one sample to the next, so that none may be left out.
  static_assert(!Vibration::observed || std::is_same_v<Samples, StrictSamples>);
};

/// Begins parts afresh.
template <class... Each>
void restart_parts(Each&... part) {
  (part.restart(), ...);
}

/// Smallest usable speed floor, per unit: where the controller's resolution ends.
inline constexpr double smallest_speed_floor = 1e-4;

/// Per unit: force on the sensor's full scale, amplitude on the actuator's limit, friction ratios
/// on base 2. A drive that is fed forward is asked for an amplitude; speed is on the peak vibration
/// velocity at full drive, so that the number is that of the vibration velocity too. A vibration
/// that is observed is asked for its velocity; that and the speed are on the range of its sensor.
template <class PartsT>
struct ControllerParameters {
  using Scalar = typename PartsT::Scalar;

  Scalar friction_force;     ///< nominal Fc
  Scalar smallest_friction;  ///< of a usable Fc, at least FrictionLevel::smallest()
  Scalar speed_floor;        ///< slower than this the ratio is undefined; > 0
  Scalar lead;               ///< from a sample to the middle of its effect, see SpeedForesight
  [[no_unique_address]] typename PartsT::Friction::Parameters friction;
  [[no_unique_address]] typename PartsT::Feedforward::Parameters feedforward;
  [[no_unique_address]] typename PartsT::Slew::Parameters slew;
  [[no_unique_address]] typename PartsT::Shaper::Parameters shaper;
  [[no_unique_address]] typename PartsT::Regulator::Parameters regulator;
  [[no_unique_address]] typename PartsT::Relearning::Parameters relearning;
  [[no_unique_address]] typename PartsT::Vibration::Parameters vibration;
  typename StandstillHold<Scalar>::Parameters standstill;
  [[no_unique_address]] typename PartsT::Stuck::Parameters stuck;
  [[no_unique_address]] typename PartsT::Plausible::Parameters plausibility;
  [[no_unique_address]] typename PartsT::Watch::Parameters watch;
  [[no_unique_address]] typename PartsT::Ceiling::Parameters ceiling{};
  [[no_unique_address]] typename PartsT::Samples::Parameters samples{};
  [[no_unique_address]] typename PartsT::Target::Parameters target{};

  template <class Self, class Visitor>
  static constexpr void fields(Self& self, Visitor&& visit) {
    visit("friction_force", self.friction_force);
    visit("smallest_friction", self.smallest_friction);
    visit("speed_floor", self.speed_floor);
    visit("lead", self.lead);
    visit("friction", self.friction);
    visit("feedforward", self.feedforward);
    visit("slew", self.slew);
    visit("shaper", self.shaper);
    visit("regulator", self.regulator);
    visit("relearning", self.relearning);
    visit("vibration", self.vibration);
    visit("standstill", self.standstill);
    visit("stuck", self.stuck);
    visit("plausibility", self.plausibility);
    visit("watch", self.watch);
    visit("ceiling", self.ceiling);
    visit("samples", self.samples);
    visit("target", self.target);
  }
};

}  // namespace sonoglide::control
