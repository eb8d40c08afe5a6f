/// The parts of a designed controller, chosen among at run time.
#pragma once

#include <cstddef>
#include <type_traits>
#include <variant>

#include "firmware/control/feedback/adaptive_regulator.hpp"
#include "firmware/control/feedback/contact_foresight.hpp"
#include "firmware/control/feedback/contact_lead.hpp"
#include "firmware/control/feedback/integral_regulator.hpp"
#include "firmware/control/feedback/scaling_regulator.hpp"
#include "firmware/control/force_sensing.hpp"
#include "firmware/control/friction/coulomb_feedforward.hpp"
#include "firmware/control/friction/dahl_feedforward.hpp"
#include "firmware/control/friction/friction_tracking.hpp"
#include "firmware/control/friction/learnt_friction.hpp"
#include "firmware/control/friction/periodic_relearning.hpp"
#include "firmware/control/friction/tabulated_feedforward.hpp"
#include "firmware/control/limits/current_limit.hpp"
#include "firmware/control/limits/notch_shaper.hpp"
#include "firmware/control/limits/slew_limit.hpp"
#include "firmware/control/target.hpp"
#include "firmware/control/vibration/biased_damping.hpp"
#include "firmware/control/vibration/damped_vibration.hpp"
#include "firmware/control/vibration/fed_forward.hpp"
#include "firmware/control/vibration/reading_lag.hpp"
#include "firmware/control/vibration/resonant_vibration.hpp"
#include "firmware/control/vibration/sensorless_vibration.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/configure/controller_parameters.hpp"

namespace sonoglide::configure {

/// One of these types.
template <class... Ts>
using Choice = std::variant<Type<Ts>...>;

/// The alternative of an index, or the last one.
template <class Some, std::size_t First = 0>
Some choose(std::size_t index) {
  if constexpr (First + 1 < std::variant_size_v<Some>) {
    if (index != First) {
      return choose<Some, First + 1>(index);
    }
  }
  return std::variant_alternative_t<First, Some>{};
}
/// The second alternative where `second`, else the first.
template <class Some>
Some choose(bool second) {
  return choose<Some>(std::size_t{second ? 1U : 0U});
}

/// Q15 is too coarse for it.
template <class Scalar>
inline constexpr bool can_observe_vibration = sizeof(Scalar) >= 4;

/// Nor does it resolve the variances of friction that is learnt while driving.
template <class Scalar>
inline constexpr bool can_track_friction = sizeof(Scalar) >= 4;

/// How the drive acts on the vibration.
template <class Scalar>
struct VibrationParts {
  template <template <class> class Current>
  using Resonant = control::ResonantVibration<Scalar, max_drive_delay, Current<Scalar>>;
  using Damped = control::DampedVibration<Scalar, max_drive_delay>;
  using BiasedDamped = control::BiasedDampedVibration<Scalar, max_drive_delay>;
  template <template <class> class Reading>
  using Sensorless = control::SensorlessVibration<Scalar, max_reading_delay, Reading<Scalar>>;
  template <template <class> class Reading>
  using BiasedSensorless =
      control::BiasedSensorlessVibration<Scalar, max_reading_delay, Reading<Scalar>>;
  using Part = std::conditional_t<
      can_observe_vibration<Scalar>,
      Choice<control::FedForward<Scalar>, Resonant<control::FullCurrent>,
             Resonant<control::CurrentLimit>, Damped, Sensorless<control::PromptReading>,
             Sensorless<control::LaggingReading>, BiasedDamped,
             BiasedSensorless<control::PromptReading>, BiasedSensorless<control::LaggingReading>,
             control::BalancedFedForward<Scalar>>,
      Choice<control::FedForward<Scalar>>>;

  static Part chosen(const ControlDesign& design) {
    if constexpr (can_observe_vibration<Scalar>) {
      switch (design.vibration_mode()) {
        case scene::VibrationMode::feedforward:
          return design.bias ? Part(Type<control::BalancedFedForward<Scalar>>{})
                             : Part(Type<control::FedForward<Scalar>>{});
        case scene::VibrationMode::sensorless:
          return design.in_mode<SensorlessDesign>()->lags()
                     ? sensorless<control::LaggingReading>(design)
                     : sensorless<control::PromptReading>(design);
        case scene::VibrationMode::damped:
          return design.bias ? Part(Type<BiasedDamped>{}) : Part(Type<Damped>{});
        case scene::VibrationMode::resonant:
          return design.resonance()->current_limited ? Part(Type<Resonant<control::CurrentLimit>>{})
                                                     : Part(Type<Resonant<control::FullCurrent>>{});
      }
    }
    return Part(Type<control::FedForward<Scalar>>{});
  }

 private:
  template <template <class> class Reading>
  static Part sensorless(const ControlDesign& design) {
    return design.bias ? Part(Type<BiasedSensorless<Reading>>{})
                       : Part(Type<Sensorless<Reading>>{});
  }
};

/// What stands between request and drive; it holds the longest notch that a design may have.
template <class Scalar>
struct ShaperParts {
  using Three = control::NotchShaper<Scalar, max_notch_spacing, 3>;
  using Five = control::NotchShaper<Scalar, max_robust_spacing, 5>;
  using Part = Choice<control::NoShaping<Scalar>, Three, Five>;

  static Part chosen(const ControlDesign& design) {
    if (design.notch() == nullptr) {
      return Part(Type<control::NoShaping<Scalar>>{});
    }
    return design.notch()->tap_count == Three::tap_count ? Part(Type<Three>{}) : Part(Type<Five>{});
  }
};

/// Feedback in friction ratio.
template <class Scalar>
struct RegulatorParts {
  using None = control::NoFeedback<Scalar>;
  using Integral = control::IntegralRegulator<Scalar, max_reference_delay>;
  using Scaling = control::ScalingRegulator<Scalar, max_reference_delay>;
  using Adaptive = control::AdaptiveRegulator<Scalar, max_reference_delay>;
  using Lead = control::ContactLead<None>;
  using LedIntegral = control::ContactLead<Integral>;
  using ForeseenIntegral = control::ContactForesight<Integral>;
  using ForeseenAdaptive = control::ContactForesight<Adaptive>;
  using Part = Choice<None, Integral, Scaling, Adaptive, Lead, LedIntegral, ForeseenIntegral,
                      ForeseenAdaptive>;

  static Part chosen(const ControlDesign& design) {
    const bool leads = design.contact_lead > 0.0;
    if (!design.senses_force || design.integral_gain == 0.0) {
      return leads ? Part(Type<Lead>{}) : Part(Type<None>{});
    }
    if (design.adaptive_gain) {
      return design.contact_foresight ? Part(Type<ForeseenAdaptive>{}) : Part(Type<Adaptive>{});
    }
    if (design.contact_foresight) {
      return Part(Type<ForeseenIntegral>{});
    }
    if (design.resonance() != nullptr && design.resonance()->scales) {
      return Part(Type<Scaling>{});
    }
    return leads ? Part(Type<LedIntegral>{}) : Part(Type<Integral>{});
  }
};

/// The leanest parts that do what a design asks for; notch and regulator hold the longest that a
/// design may have. The members are called as those of control::Controller::Parameters.
template <class Scalar>
struct ControllerParts {
  Choice<control::TrustedFriction<Scalar>, control::LearntFriction<Scalar>> friction;
  Choice<control::CoulombFeedforward<Scalar>, control::DahlFeedforward<Scalar>,
         control::TrackedDahlFeedforward<Scalar>, control::TabulatedFeedforward<Scalar>>
      feedforward;
  Choice<control::NoSlewLimit<Scalar>, control::SlewLimit<Scalar>> slew;
  typename ShaperParts<Scalar>::Part shaper;
  typename RegulatorParts<Scalar>::Part regulator;
  Choice<control::NoRelearning<Scalar>, control::PeriodicRelearning<Scalar>,
         control::FrictionTracking<Scalar>>
      relearning;
  typename VibrationParts<Scalar>::Part vibration;
  Choice<control::ForceSensor, control::NoForceSensor> force;
  Choice<control::RatioTarget<Scalar>, control::ForceTarget<Scalar>> target;

  explicit ControllerParts(const ControlDesign& design)
      : friction(choose<decltype(friction)>(design.calibrated)),
        feedforward(choose<decltype(feedforward)>(feedforward_of(design))),
        slew(choose<decltype(slew)>(design.slew_limited)),
        shaper(ShaperParts<Scalar>::chosen(design)),
        regulator(RegulatorParts<Scalar>::chosen(design)),
        relearning(choose<decltype(relearning)>(relearning_of(design))),
        vibration(VibrationParts<Scalar>::chosen(design)),
        force(choose<decltype(force)>(!design.senses_force)),
        target(choose<decltype(target)>(design.holds_force)) {}

  /// Calls visit(name, choice) for each, in the order of control::Parts. A target that is a ratio is
  /// the usual one, and not named; nor is a drive that is fed forward, and the force sensor, which a
  /// vibration that is not observed has, unless something after them is.
  template <class Visitor>
  void fields(Visitor&& visit) const {
    visit("friction", friction);
    visit("feedforward", feedforward);
    visit("slew", slew);
    visit("shaper", shaper);
    visit("regulator", regulator);
    visit("relearning", relearning);
    const bool of_force = target.index() != 0;
    std::visit(
        [&](auto chosen) {
          using Vibration = typename decltype(chosen)::type;
          if (of_force || !std::is_same_v<Vibration, control::FedForward<Scalar>>) {
            visit("vibration", vibration);
          }
          if (of_force || Vibration::observed) {
            visit("force", force);
          }
        },
        vibration);
    if (of_force) {
      visit("target", target);
    }
  }

 private:
  static std::size_t feedforward_of(const ControlDesign& design) {
    switch (design.map) {
      case scene::FrictionMap::coulomb:
        return 0;
      case scene::FrictionMap::dahl:
        return design.tracks ? 2 : 1;
      case scene::FrictionMap::tabulated:
        break;
    }
    return 3;
  }
  static std::size_t relearning_of(const ControlDesign& design) {
    return design.tracks ? 2 : (design.relearns ? 1 : 0);
  }
};

}  // namespace sonoglide::configure
