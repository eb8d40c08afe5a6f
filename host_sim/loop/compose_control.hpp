/// The controller of a scene, composed with every part that it may name.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "firmware/app/control_loop.hpp"
#include "firmware/app/texture.hpp"
#include "firmware/control/controller.hpp"
#include "hal/host/simulated_board.hpp"
#include "host_sim/configure/controller_parameters.hpp"
#include "host_sim/configure/controller_parts.hpp"
#include "host_sim/loop/control_port.hpp"
#include "host_sim/loop/friction_belief.hpp"

namespace sonoglide::loop {
namespace compose {

using configure::ControlDesign;

/// Whether a vibration leads the frequency of its drive.
template <class Vibration, class = void>
inline constexpr bool leads_frequency = false;
template <class Vibration>
inline constexpr bool leads_frequency<
    Vibration, std::void_t<decltype(std::declval<const Vibration&>().next_frequency())>> = true;

/// How long the steps of a controller are.
template <class Vibration>
auto steps_of(const ControlDesign& design) {
  if constexpr (leads_frequency<Vibration>) {
    return app::WordedSteps{design.texture->weight, design.resonance()->start_word};
  } else {
    return app::EqualSteps{design.texture->weight};
  }
}

/// A texture with the targets that it points to.
template <class Scalar, class Vibration>
class OwnTexture {
  using Targets = app::TextureTargets<Scalar, decltype(steps_of<Vibration>(ControlDesign{}))>;
  using Schedule = decltype(app::schedule_of(std::declval<const Targets&>()));

 public:
  explicit OwnTexture(const ControlDesign& design)
      : points_(points(design)),
        targets_{steps_of<Vibration>(design),
                 {design.texture->period, design.texture->inverse, design.texture->lead},
                 points_.data(),
                 static_cast<std::uint16_t>(points_.size())},
        schedule_(targets_) {}
  OwnTexture(const OwnTexture&) = delete;
  OwnTexture& operator=(const OwnTexture&) = delete;

  Schedule& schedule() { return schedule_; }
  const Schedule& schedule() const { return schedule_; }

 private:
  static std::vector<Scalar> points(const ControlDesign& design) {
    std::vector<Scalar> points;
    for (const double value : design.texture->values) {
      points.push_back(configure::target_of<Scalar>(design, value));
    }
    return points;
  }

  std::vector<Scalar> points_;
  Targets targets_;
  Schedule schedule_;
};

template <class Parts>
class InProcess : public ControlPort {
  using Controller = control::Controller<Parts>;
  using Scalar = typename Parts::Scalar;

 public:
  using Sample = app::SampleOf<Controller>;
  using Drive = app::DriveOf<Controller>;

  explicit InProcess(const ControlDesign& design)
      : design_(design),
        parameters_(configure::controller_parameters<Parts>(design)),
        controller_(parameters_),
        loop_(controller_, board_) {
    if (design.texture) {
      texture_.emplace(design);
    }
    controller_.start();
  }

  void set_target(double target) override {
    texture_.reset();
    controller_.set_target(configure::target_of<Scalar>(design_, target));
  }

  std::vector<numeric::SignalRecord> signals() const override {
    return {ledger_.signals.begin(),
            ledger_.signals.begin() + static_cast<std::ptrdiff_t>(ledger_.size)};
  }

  std::optional<FrictionBelief> friction() const override {
    if constexpr (std::is_same_v<typename Parts::Relearning, control::FrictionTracking<Scalar>>) {
      return friction_belief(controller_.friction_level(), controller_.relearning(),
                             !controller_.doubts());
    }
    return std::nullopt;
  }

  void copy_state(StateCopy& copy) override {
    copy(controller_);
    controller_.settle_at(parameters_);
    copy_texture(copy);
  }

 protected:
  Drive answer(const Sample& sample) {
    const numeric::LedgerScope scope(ledger_);
    board_.post(sample);
    if (texture_) {
      texture_->schedule().advance(controller_);
      loop_.serve(texture_->schedule());
    } else {
      loop_.serve();
    }
    return board_.latest_drive();
  }

 private:
  void copy_texture(StateCopy& copy) {
    bool follows = texture_.has_value();
    copy(follows);
    if (copy.is_back()) {
      texture_.reset();
      if (follows) {
        texture_.emplace(design_);
      }
    }
    if (follows) {
      auto place = texture_->schedule().state();
      copy(place);
      texture_->schedule().set_state(place);
    }
  }

  using Board = hal::host::SimulatedBoard<Sample, Drive>;

  ControlDesign design_;
  typename Controller::Parameters parameters_;
  Controller controller_;
  Board board_;
  app::ControlLoop<Controller, Board> loop_;
  std::optional<OwnTexture<Scalar, typename Parts::Vibration>>
      texture_;  ///< none once another target is set
  numeric::SignalLedger ledger_;
};

template <class Parts>
class InProcessControl final : public InProcess<Parts> {
 public:
  using InProcess<Parts>::InProcess;
  using typename InProcess<Parts>::Sample;
  using typename InProcess<Parts>::Drive;
  using ControlPort::exchange;

  Drive exchange(const Sample& sample) override { return this->answer(sample); }
};

template <class Parts>
class InProcessBiasedControl final : public InProcess<Parts> {
 public:
  using InProcess<Parts>::InProcess;
  using typename InProcess<Parts>::Sample;
  using ControlPort::exchange_biased;

  hal::BiasedDrive exchange_biased(const Sample& sample) override { return this->answer(sample); }
};

template <class Parts>
std::unique_ptr<ControlPort> in_process(const ControlDesign& design) {
  using Drive = app::DriveOf<control::Controller<Parts>>;
  if constexpr (std::is_same_v<Drive, hal::BiasedDrive>) {
    return std::make_unique<InProcessBiasedControl<Parts>>(design);
  } else {
    return std::make_unique<InProcessControl<Parts>>(design);
  }
}

/// The inverse map, but for friction that is learnt while driving.
template <class Scalar>
auto map_of(const ControlDesign& design) {
  return configure::choose<
      configure::Choice<control::CoulombFeedforward<Scalar>, control::DahlFeedforward<Scalar>,
                        control::TabulatedFeedforward<Scalar>>>(
      static_cast<std::size_t>(design.map));
}

/// Few scenes name a slew limit or relearning: they share compositions that have both, the one that
/// a scene does not name being wide open. So is a target that is a force. Every composition that is fed forward has a regulator, whose
/// gain is 0 where there is no feedback. The commands are those of the leanest parts, bit for bit.
template <class SlewT, class RelearningT>
struct Extras {
  using Slew = SlewT;
  using Relearning = RelearningT;
};
template <class Scalar>
using ExtrasChoice =
    configure::Choice<Extras<control::NoSlewLimit<Scalar>, control::NoRelearning<Scalar>>,
                      Extras<control::SlewLimit<Scalar>, control::PeriodicRelearning<Scalar>>>;

/// Few scenes have a law whose map is tabulated: they have both too.
template <class Scalar, class Feedforward, class Chosen>
using FewerExtras =
    std::conditional<std::is_same_v<Feedforward, control::TabulatedFeedforward<Scalar>>,
                     Extras<control::SlewLimit<Scalar>, control::PeriodicRelearning<Scalar>>,
                     Chosen>;

/// Relearning, a target force, the current limit of a resonant loop and its scale are wide open where a scene does
/// not name them.
template <class Scalar, class Friction, class Feedforward, class Regulator, class Vibration,
          class Force>
using ObservedParts = control::Parts<
    Scalar, Friction, Feedforward, control::NoSlewLimit<Scalar>, control::NoShaping<Scalar>,
    Regulator,
    std::conditional_t<Force::present, control::PeriodicRelearning<Scalar>,
                       control::NoRelearning<Scalar>>,
    Vibration, Force,
    std::conditional_t<Force::present, control::ForceTarget<Scalar>, control::RatioTarget<Scalar>>>;

template <class Scalar, class Vibration,
          template <class, int> class Regulator = control::IntegralRegulator>
std::unique_ptr<ControlPort> make_observing_control(const ControlDesign& design) {
  const configure::ControllerParts<Scalar> parts(design);
  return std::visit(
      [&](auto friction, auto feedforward) -> std::unique_ptr<ControlPort> {
        using Friction = typename decltype(friction)::type;
        using Feedforward = typename decltype(feedforward)::type;
        if (design.senses_force) {
          using Feedback = Regulator<Scalar, configure::max_reference_delay>;
          return in_process<ObservedParts<Scalar, Friction, Feedforward, Feedback, Vibration,
                                          control::ForceSensor>>(design);
        }
        return in_process<
            ObservedParts<Scalar, control::TrustedFriction<Scalar>, Feedforward,
                          control::NoFeedback<Scalar>, Vibration, control::NoForceSensor>>(design);
      },
      parts.friction, map_of<Scalar>(design));
}

/// Relearning, a target force and the lead of a reading are wide open where a scene does not name them.
template <class Scalar, class Vibration>
std::unique_ptr<ControlPort> make_feeling_control(const ControlDesign& design) {
  const configure::ControllerParts<Scalar> parts(design);
  return std::visit(
      [&](auto friction, auto feedforward) -> std::unique_ptr<ControlPort> {
        using Parts =
            control::Parts<Scalar, typename decltype(friction)::type,
                           typename decltype(feedforward)::type, control::NoSlewLimit<Scalar>,
                           control::NoShaping<Scalar>, control::NoFeedback<Scalar>,
                           control::PeriodicRelearning<Scalar>, Vibration, control::ForceSensor,
                           control::ForceTarget<Scalar>>;
        return in_process<Parts>(design);
      },
      parts.friction, map_of<Scalar>(design));
}

/// Friction that is learnt while driving; the slew limit is wide open where a scene does not name it.
template <class Scalar>
std::unique_ptr<ControlPort> make_tracking_control(const ControlDesign& design) {
  return std::visit(
      [&](auto shaper) -> std::unique_ptr<ControlPort> {
        using Parts =
            control::Parts<Scalar, control::TrustedFriction<Scalar>,
                           control::TrackedDahlFeedforward<Scalar>, control::SlewLimit<Scalar>,
                           typename decltype(shaper)::type,
                           control::IntegralRegulator<Scalar, configure::max_reference_delay>,
                           control::FrictionTracking<Scalar>>;
        return std::make_unique<InProcessControl<Parts>>(design);
      },
      configure::ControllerParts<Scalar>(design).shaper);
}

}  // namespace compose

template <class Scalar>
std::unique_ptr<ControlPort> make_control(const configure::ControlDesign& design) {
  using namespace compose;
  if constexpr (configure::can_observe_vibration<Scalar>) {
    using configure::max_drive_delay;
    using configure::max_reading_delay;
    using Lagging = control::LaggingReading<Scalar>;
    using Current = control::CurrentLimit<Scalar>;
    switch (design.vibration_mode()) {
      case scene::VibrationMode::feedforward:
        break;
      case scene::VibrationMode::sensorless:
        return design.bias
                   ? make_feeling_control<Scalar, control::BiasedSensorlessVibration<
                                                      Scalar, max_reading_delay, Lagging>>(design)
                   : make_feeling_control<
                         Scalar, control::SensorlessVibration<Scalar, max_reading_delay, Lagging>>(
                         design);
      case scene::VibrationMode::damped:
        if (design.bias) {
          return make_observing_control<Scalar,
                                        control::BiasedDampedVibration<Scalar, max_drive_delay>>(
              design);
        }
        return make_observing_control<Scalar, control::DampedVibration<Scalar, max_drive_delay>>(
            design);
      case scene::VibrationMode::resonant:
        return make_observing_control<Scalar,
                                      control::ResonantVibration<Scalar, max_drive_delay, Current>,
                                      control::ScalingRegulator>(design);
    }
  }
  if constexpr (configure::can_track_friction<Scalar>) {
    if (design.tracks) {
      return make_tracking_control<Scalar>(design);
    }
  }
  const configure::ControllerParts<Scalar> parts(design);
  return std::visit(
      [&](auto friction, auto feedforward, auto shaper,
          auto extras) -> std::unique_ptr<ControlPort> {
        using Chosen = typename FewerExtras<Scalar, typename decltype(feedforward)::type,
                                            typename decltype(extras)::type>::type;
        using Parts =
            control::Parts<Scalar, typename decltype(friction)::type,
                           typename decltype(feedforward)::type, typename Chosen::Slew,
                           typename decltype(shaper)::type,
                           control::IntegralRegulator<Scalar, configure::max_reference_delay>,
                           typename Chosen::Relearning, control::FedForward<Scalar>,
                           control::ForceSensor, control::ForceTarget<Scalar>>;
        return std::make_unique<InProcessControl<Parts>>(design);
      },
      parts.friction, map_of<Scalar>(design), parts.shaper,
      configure::choose<ExtrasChoice<Scalar>>(design.slew_limited || design.relearns));
}

}  // namespace sonoglide::loop
