/// The friction-ratio controller.
#pragma once

#include <cstdint>

#include "firmware/control/parts.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// Picks the drive so that the friction ratio, or the friction force, reaches a target; one step per
/// carrier period. A pure function of its state and the measurement: no clock, no I/O, no heap.
/// Per unit, on the bases of ControllerParameters.
template <class PartsT>
class Controller {
 public:
  using Scalar = typename PartsT::Scalar;
  using Measurement = typename PartsT::Vibration::Measurement;
  using Command = typename PartsT::Vibration::Command;
  using Parameters = ControllerParameters<PartsT>;
  static constexpr bool reads_force = PartsT::Force::present;

  /// @param parameters  outlive this: a part may leave a table where it is
  explicit Controller(const Parameters& parameters)
      : configured_friction_(parameters.friction_force),
        smallest_friction_(parameters.smallest_friction),
        speed_floor_(parameters.speed_floor),
        foresight_(parameters.lead),
        friction_(parameters.friction),
        feedforward_(parameters.feedforward),
        slew_(parameters.slew),
        shaper_(parameters.shaper),
        regulator_(parameters.regulator),
        relearning_(parameters.relearning),
        vibration_(parameters.vibration),
        standstill_(parameters.standstill),
        stuck_(parameters.stuck),
        plausibility_(parameters.plausibility),
        watch_(parameters.watch),
        ceiling_(parameters.ceiling),
        samples_(parameters.samples),
        level_(parameters.friction_force),
        aim_(parameters.target) {}

  /// Makes a copy, or the bytes, of a controller that stood elsewhere its own.
  /// @param parameters  of a controller with the same map and vibration, and equal to its own; outlive this
  template <class EqualParameters>
  void settle_at(const EqualParameters& parameters) {
    feedforward_.settle_at(parameters.feedforward);
    vibration_.settle_at(parameters.vibration);
  }

  /// Begins afresh, from any state, with calibration where there is one. A target that is set
  /// already becomes one here, as if it were set next: until then no drive is asked for.
  void start() {
    const Scalar target = aim_.give_back(target_);
    target_ = whole_ratio<Scalar>;
    restart_parts(friction_, shaper_);
    regulator_.restart(target_);
    restart_parts(standstill_, stuck_, plausibility_, watch_, foresight_, samples_, relearning_);
    vibration_.restart(!runs(state_));
    backwards_ = false;
    requested_ = Scalar{};
    if (!drives(state_) || friction_.learning()) {
      commanded_ = whole_ratio<Scalar>;  // else the reading may stand still, as the command does
    }
    followed_ = true;
    fault_ = Fault::none;
    state_ = State::calibrating;
    if (!friction_.learning()) {
      adopt_friction();
    }
    set_target(target);
  }

  /// Drive to zero until the next start(). Forgets the cause of a fault.
  void stop() {
    state_ = State::off;
    fault_ = Fault::none;
  }

  /// A step in which the drive is at zero, whatever is asked for.
  Command rest() {
    Command command{no_drive<Scalar>(State::off, Limit::none, Fault::none)};
    vibration_.after(command);
    return command;
  }

  /// @param target  friction ratio or force, see RatioTarget::take() and ForceTarget::take(). One that is
  ///                not finite leaves the old one in force.
  void set_target(Scalar target) {
    if (!numeric::is_finite(target)) {
      return;
    }
    aim_.take(target, friction_.believed(configured_friction_), level_);
    const Scalar ratio = numeric::clamp_positive(target, whole_ratio<Scalar>);
    if (ratio != target_) {
      regulator_.target_changes(ratio - target_);
      watch_.retarget();
      vibration_.retarget(ratio - target_);
      target_ = ratio;
    }
  }

  /// Frequency of the period whose sample comes next, in steps of its word from the start.
  std::int32_t next_frequency() const { return vibration_.next_frequency(); }

  /// What is known of the friction.
  const FrictionLevel<Scalar>& friction_level() const { return level_; }
  const typename PartsT::Relearning& relearning() const { return relearning_; }
  /// Whether the measured ratio speaks against what is known of the friction.
  bool doubts() const { return watch_.doubts(); }

  /// Answer to one carrier period, valid for the next.
  template <Numbers Known = Numbers::any>
  Command step(const Measurement& measurement) {
    vibration_.before();
    Command command{answer(measurement, inspect<typename PartsT::Force, Known>(measurement))};
    vibration_.balance(command, [&] { return expected_friction(measurement, command.limit); });
    vibration_.after(command);
    return command;
  }

 private:
  using Request = control::Request<Scalar>;

  DriveCommand<Scalar> answer(const Measurement& measurement, Fault unusable) {
    if (!runs(state_)) {
      return undriven(Limit::none);
    }
    if (!samples_.accept(unusable == Fault::none)) {
      trip(unusable);
      return undriven(Limit::none);
    }
    if (unusable != Fault::none) {
      if (state_ == State::calibrating) {
        return undriven(Limit::bad_sample);
      }
      regulator_.hold();  // tolerated: the last request stands, and no part judges the sample
      return apply({requested_, Limit::bad_sample});
    }
    if (const Fault unsound = vibration_.observe(measurement); unsound != Fault::none) {
      trip(unsound);
      return undriven(Limit::none);
    }
    const Scalar velocity = measurement.sliding_velocity;
    // At its rail it is none to go on from.
    const Scalar speed = measurement.velocity_at_rail ? Scalar{} : foresight_.speed(velocity);
    if (state_ == State::calibrating) {
      return calibrate(measurement);
    }
    if (numeric::is_negative(velocity) != backwards_) {
      backwards_ = !backwards_;
      interrupt();  // readings that are still on their way belong to the other direction
    }
    const Request wanted =
        speed < speed_floor_
            ? stand(measurement.velocity_at_rail ? Limit::velocity_at_rail : Limit::speed_floor)
            : slide(measurement, speed);
    return state_ == State::fault ? undriven(Limit::none) : apply(wanted);
  }

  Request trip(Fault fault) {
    state_ = State::fault;
    fault_ = fault;
    return {Scalar{}, Limit::none};
  }

  DriveCommand<Scalar> undriven(Limit limit) const {
    return no_drive<Scalar>(state_, limit, fault_);
  }

  /// That of the target, with the sign of a sample; without a drive that of the sample.
  Scalar expected_friction(const Measurement& measurement, Limit limit) const {
    const bool driven =
        drives(state_) && limit != Limit::speed_floor && limit != Limit::velocity_at_rail;
    if (PartsT::Force::present && !driven) {
      return measurement.friction_force;
    }
    const Scalar force = level_.force_at(target_);
    return backwards_ ? -force : force;
  }

  /// Learns one sample of the undriven friction. The drive begins a period after the last one.
  DriveCommand<Scalar> calibrate(const Measurement& measurement) {
    const bool slow = numeric::abs(measurement.sliding_velocity) < speed_floor_;
    const DriveCommand<Scalar> silent = undriven(slow ? Limit::speed_floor : Limit::none);
    backwards_ = numeric::is_negative(measurement.sliding_velocity);
    friction_.learn(measurement.friction_force, measurement.sliding_velocity, slow);
    if (friction_.learning()) {
      return silent;
    }
    adopt_friction();
    return state_ == State::fault ? undriven(Limit::none) : silent;
  }

  /// Takes Fc; a force too small for one is a fault, as is friction that pulls.
  void take_friction_force(Scalar force) {
    if (force < smallest_friction_) {
      trip(force < -smallest_friction_ ? Fault::measurement_implausible
                                       : Fault::friction_not_learnt);
      return;
    }
    level_ = FrictionLevel<Scalar>(force);
    state_ = State::running;
  }

  /// Takes Fc and adapts the inverse map to it.
  void adopt_friction() {
    take_friction_force(friction_.friction_force(configured_friction_));
    relearning_.adapt(feedforward_, level_);
    aim_.follow(friction_.believed(configured_friction_), level_, target_);
    map_.forget();
  }

  void interrupt() {
    regulator_.hold();
    plausibility_.restart();
    relearning_.interrupt(feedforward_, level_);
  }

  /// Answer below the speed floor, or above the range of the speed's converter: feedback waits, and the
  /// last request stands for a while; a target of no drive gives none here either.
  Request stand(Limit limit) {
    interrupt();
    return is_whole(target_) ? slewed({Scalar{}, Limit::none})
                             : slewed({standstill_.request(requested_), limit});
  }

  /// Answer at a sliding that is fast enough for a friction ratio, as far as a sensor tells one.
  Request slide(const Measurement& measurement, Scalar speed) {
    standstill_.restart();
    if constexpr (!PartsT::Force::present) {
      return regulate(target_, speed);
    } else {
      const Scalar velocity = measurement.sliding_velocity;
      const Scalar force = friction_.without_offset(measurement.friction_force);
      const Scalar along = backwards_ ? -force : force;
      const Scalar measured = level_.half_ratio(along);
      const Fault implausible = plausibility_.judge(aim_.judged(measured), velocity);
      if (implausible != Fault::none) {
        return trip(implausible);
      }
      if (stuck_.stuck(measurement.friction_force, measured, commanded_, followed_)) {
        return trip(Fault::measurement_stuck);
      }
      vibration_.sense(measured, numeric::abs(velocity), backwards_, feedforward_);
      const Task task = next_task({along, measured, speed, commanded_, requested_, followed_});
      if (task != Task::regulate) {
        regulator_.hold();
      }
      return task == Task::regulate || task == Task::resume ? regulate(measured, speed)
                                                            : pause(task, speed);
    }
  }

  /// What relearning asks for in this period. Without a drive there is nothing to pause.
  Task next_task(const FrictionReading<Scalar>& reading) {
    if (!is_whole(target_)) {
      return relearning_.next(reading, feedforward_);
    }
    relearning_.interrupt(feedforward_, level_);
    return Task::regulate;
  }

  /// Answer in a pause of the drive.
  Request pause(Task task, Scalar speed) {
    if (task == Task::learn) {
      return learn_anew();
    }
    if (task == Task::adapt) {
      relearning_.adapt(feedforward_, level_);
      relearning_.align(regulator_, feedforward_, speed, requested_);
      return {requested_, Limit::none};
    }
    commanded_ = whole_ratio<Scalar>;
    return slewed({relearning_.request(speed), Limit::none});
  }

  /// Takes the friction force learnt while driving. The request stands in this period, and in the
  /// next, in which the map adapts.
  Request learn_anew() {
    const Scalar before = level_.force();
    const Scalar target_force = level_.force_at(target_);
    take_friction_force(relearning_.force(before));
    relearning_.correct(regulator_, {target_, commanded_, before, level_.half_ratio(target_force),
                                     watch_.limit_named() != Limit::not_settling});
    watch_.forget_disagreement();
    return {requested_, Limit::none};
  }

  Request regulate(Scalar measured, Scalar speed) {
    // No drive can bring an undriven reading to its target.
    if (is_whole(target_) || !vibration_.settled()) {
      regulator_.hold();
    }
    regulator_.learn_scale([&](Scalar ratio) { return feedforward_.amplitude(ratio, speed); });
    const Scalar ratio = regulator_.propose(target_, aim_.reading(measured, target_, commanded_));
    if (!numeric::likely(!is_whole(target_))) {
      return release(ratio);
    }
    const Request wanted = feedforward(ratio, speed);
    const Scalar amplitude = slew_.limit(wanted.amplitude, requested_);
    const bool held_below = amplitude < wanted.amplitude;
    const bool held_above = wanted.amplitude < amplitude;
    const bool at_most =
        wanted.limit == PartsT::Vibration::at_full_drive || held_below || vibration_.at_most();
    const bool at_least = is_whole(ratio) || held_above;
    regulator_.accept(at_most, at_least);
    commanded_ = regulator_.implied(ratio);
    if (!relearning_.pausing()) {
      judge(measured, speed, at_most || at_least);
    }
    return {amplitude, held_below || held_above ? Limit::slew : wanted.limit};
  }

  /// An amplitude that no feedback asks for, as fast as the actuator may change.
  Request slewed(const Request& wanted) {
    return {slew_.limit(wanted.amplitude, requested_), wanted.limit};
  }

  /// Answer to a target of no drive: there is nothing to correct or to judge.
  Request release(Scalar ratio) {
    regulator_.accept(false, false);
    commanded_ = regulator_.implied(ratio);
    watch_.restart();
    const Scalar amplitude = slew_.limit(Scalar{}, requested_);
    return {amplitude, Scalar{} < amplitude ? Limit::slew : Limit::none};
  }

  /// Judges the measured ratio under a drive.
  void judge(Scalar measured, Scalar speed, bool clamped) {
    const Scalar implied = vibration_.implied_ratio(commanded_, [&](auto velocity) {
      return watch_.implied_ratio(target_, requested_, velocity, [&](Scalar ratio) {
        return feedforward_.amplitude(ratio, speed);
      });
    });
    watch_.judge(target_, measured, implied, clamped);
  }

  /// Amplitude for a commanded ratio, from the inverse map.
  Request feedforward(Scalar half_ratio, Scalar speed) {
    const Scalar amplitude = regulator_.scaled(map_.amplitude(feedforward_, half_ratio, speed));
    const Scalar highest = vibration_.highest(ceiling_.highest());
    if (!(amplitude < highest)) {
      return {highest, PartsT::Vibration::at_full_drive};
    }
    return {amplitude, is_whole(half_ratio) ? Limit::ratio_end : Limit::none};
  }

  DriveCommand<Scalar> apply(const Request& request) {
    requested_ = numeric::observe<typename PartsT::Vibration::Requested>(request.amplitude);
    Request driven = vibration_.drive(requested_, shaper_, ceiling_.highest());
    if constexpr (PartsT::Vibration::observed) {
      driven = ceiling_.held(driven, PartsT::Vibration::at_full_drive);
    }
    return conclude(driven.amplitude, request.limit == Limit::none ? driven.limit : request.limit);
  }

  DriveCommand<Scalar> conclude(Scalar amplitude, Limit limit) {
    followed_ = vibration_.settled() && (limit == Limit::none || limit == Limit::ratio_end);
    const bool judged = limit == Limit::none && !relearning_.pausing();
    const Limit named = judged ? watch_.limit_named() : limit;
    const Settling settling = judged ? watch_.settling() : Settling::pending;
    const State driving = named == Limit::none ? State::running : State::limited;
    state_ = relearning_.pausing() ? State::relearning : driving;
    return {amplitude, vibration_.reported_ratio(commanded_), state_, named, fault_, settling};
  }

  Scalar configured_friction_;
  Scalar smallest_friction_;
  Scalar speed_floor_;
  SpeedForesight<Scalar> foresight_;
  [[no_unique_address]] typename PartsT::Friction friction_;
  [[no_unique_address]] typename PartsT::Feedforward feedforward_;
  [[no_unique_address]] typename PartsT::Map map_;
  [[no_unique_address]] typename PartsT::Slew slew_;
  [[no_unique_address]] typename PartsT::Shaper shaper_;
  [[no_unique_address]] typename PartsT::Regulator regulator_;
  [[no_unique_address]] typename PartsT::Relearning relearning_;
  [[no_unique_address]] typename PartsT::Vibration vibration_;
  StandstillHold<Scalar> standstill_;
  [[no_unique_address]] typename PartsT::Stuck stuck_;
  [[no_unique_address]] typename PartsT::Plausible plausibility_;
  [[no_unique_address]] typename PartsT::Watch watch_;
  [[no_unique_address]] typename PartsT::Ceiling ceiling_;
  [[no_unique_address]] typename PartsT::Samples samples_;
  FrictionLevel<Scalar> level_;
  [[no_unique_address]] typename PartsT::Target aim_;
  Scalar target_ = whole_ratio<Scalar>;     ///< friction ratio on base 2
  Scalar commanded_ = whole_ratio<Scalar>;  ///< likewise, target and feedback together
  Scalar requested_{};                      ///< amplitude before shaping, or vibration velocity
  bool backwards_ = false;                  ///< the sliding
  bool followed_ = true;                    ///< the drive could follow the last command
  State state_ = State::off;
  Fault fault_ = Fault::none;
};

}  // namespace sonoglide::control
