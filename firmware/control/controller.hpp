/// The friction-ratio controller.
#pragma once

#include <cstdint>

#include "firmware/control/drive_command.hpp"
#include "firmware/control/friction_level.hpp"
#include "firmware/control/full_drive.hpp"
#include "firmware/control/measurement.hpp"
#include "firmware/control/signals.hpp"
#include "firmware/control/stuck_detector.hpp"
#include "firmware/numeric/accumulator.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// What a controller is made of; each part is a type, and what a part does not do costs nothing.
template <class ScalarT, class FrictionT, class FeedforwardT, class SlewT, class ShaperT,
          class RegulatorT, class CeilingT = FullDrive<ScalarT>>
struct Parts {
  using Scalar = ScalarT;
  using Friction = FrictionT;        ///< TrustedFriction | LearntFriction
  using Feedforward = FeedforwardT;  ///< CoulombFeedforward | DahlFeedforward
  using Slew = SlewT;                ///< NoSlewLimit | SlewLimit
  using Shaper = ShaperT;            ///< NoShaping | NotchShaper
  using Regulator = RegulatorT;      ///< NoFeedback | IntegralRegulator
  using Ceiling = CeilingT;          ///< FullDrive | DriveLimit
};

/// Smallest usable speed floor, per unit: where the controller's resolution ends.
inline constexpr double smallest_speed_floor = 1e-4;

/// Picks the drive amplitude so that the friction ratio reaches a target; one step per carrier
/// period. A pure function of its state and the measurement: no clock, no I/O, no heap.
///
/// Per unit: force on the sensor's full scale, speed on the peak vibration velocity at full drive,
/// amplitude on the actuator's limit, friction ratios on base 2.
template <class PartsT>
class Controller {
 public:
  using Scalar = typename PartsT::Scalar;

  struct Parameters {
    Scalar friction_force;  ///< believed Fc
    Scalar speed_floor;     ///< slower than this the ratio is undefined; > 0
    Scalar lead;            ///< from a sample to the middle of its effect, in 64 carrier periods
    [[no_unique_address]] typename PartsT::Friction::Parameters friction;
    [[no_unique_address]] typename PartsT::Feedforward::Parameters feedforward;
    [[no_unique_address]] typename PartsT::Slew::Parameters slew;
    [[no_unique_address]] typename PartsT::Shaper::Parameters shaper;
    [[no_unique_address]] typename PartsT::Regulator::Parameters regulator;
    typename StuckDetector<Scalar>::Parameters stuck;
    [[no_unique_address]] typename PartsT::Ceiling::Parameters ceiling{};
  };

  explicit Controller(const Parameters& parameters)
      : configured_friction_(parameters.friction_force),
        speed_floor_(parameters.speed_floor),
        lead_(parameters.lead),
        friction_(parameters.friction),
        feedforward_(parameters.feedforward),
        slew_(parameters.slew),
        shaper_(parameters.shaper),
        regulator_(parameters.regulator),
        stuck_(parameters.stuck),
        ceiling_(parameters.ceiling),
        level_(parameters.friction_force) {}

  /// From off or from a fault: begins afresh, with calibration where there is one.
  void start() {
    friction_.restart();
    shaper_.restart();
    regulator_.restart();
    stuck_.restart();
    last_velocity_known_ = false;
    requested_ = Scalar{};
    commanded_ = whole_ratio();
    fault_ = Fault::none;
    state_ = State::calibrating;
    if (!friction_.learning() && !take_friction_level()) {
      trip(Fault::friction_not_learnt);
    }
  }

  /// Drive to zero until the next start(); a fault's cause is forgotten.
  void stop() {
    state_ = State::off;
    fault_ = Fault::none;
  }

  /// @param half_ratio  target friction ratio on base 2, limited to [0, 1/2]; 1/2 (ρ = 1) is
  ///                    no drive at all. What is not finite leaves the target as it was.
  void set_target(Scalar half_ratio) {
    if (!numeric::is_finite(half_ratio)) {
      return;
    }
    const Scalar target = numeric::clamp(half_ratio, Scalar{}, whole_ratio());
    if (target != target_) {
      target_ = target;
      regulator_.hold();
    }
  }

  /// Answer to one carrier period, valid for the next.
  DriveCommand<Scalar> step(const Measurement<Scalar>& measurement) {
    if (state_ == State::off || state_ == State::fault) {
      return undriven(Limit::none);
    }
    const Fault fault = inspect(measurement);
    if (fault != Fault::none) {
      return trip(fault);
    }
    const bool reversed = (measurement.sliding_velocity < Scalar{}) != (last_velocity_ < Scalar{});
    const Scalar speed = numeric::abs(foresee(measurement.sliding_velocity));
    if (friction_.learning()) {
      return calibrate(measurement, reversed, speed);
    }
    if (reversed) {
      regulator_.hold();  // readings still on their way belong to the sliding before
    }
    const bool below_floor = speed < speed_floor_;
    return below_floor && target_ < whole_ratio() ? hold() : regulate(measurement, speed);
  }

 private:
  struct Request {
    Scalar amplitude;
    Limit limit;
  };

  static constexpr Scalar whole_ratio() { return numeric::from_real<Scalar>(0.5); }

  Fault inspect(const Measurement<Scalar>& measurement) {
    if (measurement.quality == Quality::missing) {
      return Fault::measurement_missing;
    }
    if (measurement.quality == Quality::saturated) {
      return Fault::measurement_saturated;
    }
    if (!numeric::is_finite(measurement.friction_force) ||
        !numeric::is_finite(measurement.sliding_velocity)) {
      return Fault::measurement_not_finite;
    }
    const bool followed = state_ == State::running;
    return stuck_.stuck(measurement.friction_force, commanded_, followed) ? Fault::measurement_stuck
                                                                          : Fault::none;
  }

  /// Sliding velocity extrapolated to the middle of the answer's effect: shaper and carrier period
  /// delay the drive, and a sliding velocity that changes would find it late.
  Scalar foresee(Scalar velocity) {
    const Scalar change = last_velocity_known_ ? velocity - last_velocity_ : Scalar{};
    last_velocity_ = velocity;
    last_velocity_known_ = true;
    return numeric::observe<signal::ForeseenVelocity>(
        velocity + numeric::rounded<Scalar>(numeric::scale_by_power_of_two(
                       numeric::accumulated_product(change, lead_), 6)));
  }

  DriveCommand<Scalar> trip(Fault fault) {
    state_ = State::fault;
    fault_ = fault;
    return undriven(Limit::none);
  }

  DriveCommand<Scalar> undriven(Limit limit) const { return {Scalar{}, state_, limit, fault_}; }

  /// Learns one sample of the undriven friction; an interrupted sliding begins anew.
  DriveCommand<Scalar> calibrate(const Measurement<Scalar>& measurement, bool reversed,
                                 Scalar foreseen_speed) {
    const bool too_slow = numeric::abs(measurement.sliding_velocity) < speed_floor_;
    if (reversed || too_slow) {
      friction_.restart();
    }
    if (too_slow) {
      return undriven(Limit::speed_floor);
    }
    friction_.learn(measurement.friction_force);
    if (friction_.learning()) {
      return undriven(Limit::none);
    }
    return take_friction_level() ? regulate(measurement, foreseen_speed)
                                 : trip(Fault::friction_not_learnt);
  }

  bool take_friction_level() {
    const Scalar force = friction_.friction_force(configured_friction_);
    if (force < FrictionLevel<Scalar>::smallest()) {
      return false;
    }
    level_ = FrictionLevel<Scalar>(force);
    feedforward_.set_friction(level_);
    state_ = State::running;
    return true;
  }

  /// Below the speed floor: the last request stands, and feedback waits.
  DriveCommand<Scalar> hold() {
    regulator_.hold();
    return apply({requested_, Limit::speed_floor});
  }

  DriveCommand<Scalar> regulate(const Measurement<Scalar>& measurement, Scalar speed) {
    if (whole_ratio() <= target_) {
      regulator_.hold();  // no drive can bring an undriven reading to its target
    }
    const Scalar along = measurement.sliding_velocity < Scalar{} ? -measurement.friction_force
                                                                 : measurement.friction_force;
    const Scalar ratio = regulator_.propose(target_, level_.half_ratio(along));
    const Request wanted = feedforward(ratio, speed);
    const Scalar slewed = slew_.limit(wanted.amplitude, requested_);
    const bool held_below = slewed < wanted.amplitude;
    const bool held_above = wanted.amplitude < slewed;
    const bool at_most = wanted.limit == Limit::actuator || held_below;
    const bool at_least = whole_ratio() <= ratio || held_above;
    regulator_.accept(at_most, at_least);

    commanded_ = ratio;
    return apply({slewed, held_below || held_above ? Limit::slew : wanted.limit});
  }

  /// Amplitude for a commanded ratio, from the inverse map.
  Request feedforward(Scalar half_ratio, Scalar speed) const {
    if (whole_ratio() <= target_) {
      return {Scalar{}, Limit::none};
    }
    const Scalar amplitude = feedforward_.amplitude(half_ratio, speed);
    const Scalar highest = ceiling_.highest();
    return amplitude < highest ? Request{amplitude, Limit::none}
                               : Request{highest, Limit::actuator};
  }

  DriveCommand<Scalar> apply(const Request& request) {
    requested_ = numeric::observe<signal::RequestedAmplitude>(request.amplitude);
    const Scalar shaped = numeric::observe<signal::ShapedAmplitude>(shaper_.shape(requested_));
    const Scalar highest = ceiling_.highest();
    const Scalar amplitude = numeric::clamp(shaped, Scalar{}, highest);
    const bool clipped = shaped < Scalar{} || (highest <= shaped && requested_ < highest);
    const Limit limit = clipped && request.limit == Limit::none ? Limit::actuator : request.limit;
    state_ = limit == Limit::none ? State::running : State::limited;
    return {amplitude, state_, limit, fault_};
  }

  Scalar configured_friction_;
  Scalar speed_floor_;
  Scalar lead_;
  [[no_unique_address]] typename PartsT::Friction friction_;
  [[no_unique_address]] typename PartsT::Feedforward feedforward_;
  [[no_unique_address]] typename PartsT::Slew slew_;
  [[no_unique_address]] typename PartsT::Shaper shaper_;
  [[no_unique_address]] typename PartsT::Regulator regulator_;
  StuckDetector<Scalar> stuck_;
  [[no_unique_address]] typename PartsT::Ceiling ceiling_;
  FrictionLevel<Scalar> level_;
  Scalar target_ = whole_ratio();
  Scalar commanded_ = whole_ratio();  ///< friction ratio, target and feedback together, on base 2
  Scalar requested_{};                ///< amplitude before shaping
  Scalar last_velocity_{};
  bool last_velocity_known_ = false;
  State state_ = State::off;
  Fault fault_ = Fault::none;
};

}  // namespace sonoglide::control
