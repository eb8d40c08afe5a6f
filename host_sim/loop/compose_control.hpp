/// The controller of a scene, composed with every part that it may name.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <variant>

#include "firmware/app/control_loop.hpp"
#include "firmware/control/controller.hpp"
#include "firmware/control/coulomb_feedforward.hpp"
#include "firmware/control/dahl_feedforward.hpp"
#include "firmware/control/integral_regulator.hpp"
#include "firmware/control/learnt_friction.hpp"
#include "firmware/control/no_shaping.hpp"
#include "firmware/control/no_slew_limit.hpp"
#include "firmware/control/notch_shaper.hpp"
#include "firmware/control/periodic_relearning.hpp"
#include "firmware/control/slew_limit.hpp"
#include "firmware/control/trusted_friction.hpp"
#include "firmware/numeric/fixed.hpp"
#include "hal/host/simulated_board.hpp"
#include "host_sim/loop/arithmetic_control.hpp"
#include "host_sim/loop/control_port.hpp"
#include "host_sim/loop/type.hpp"

namespace sonoglide::loop {
namespace compose {

using configure::ControlDesign;

template <class Scalar>
Scalar scaled(double value) {
  return numeric::from_real<Scalar>(value);
}

// The parameters of each part, scaled.

template <class Scalar>
typename control::TrustedFriction<Scalar>::Parameters parameters(
    const ControlDesign& /*design*/, Type<control::TrustedFriction<Scalar>> /*part*/) {
  return {};
}

template <class Scalar>
typename control::LearntFriction<Scalar>::Parameters parameters(
    const ControlDesign& design, Type<control::LearntFriction<Scalar>> /*part*/) {
  return {design.calibration_settle_periods, design.calibration_average_periods,
          scaled<numeric::Accumulator<Scalar>>(design.calibration_weight),
          design.calibration_total_periods};
}

template <class Scalar>
typename control::CoulombFeedforward<Scalar>::Parameters parameters(
    const ControlDesign& /*design*/, Type<control::CoulombFeedforward<Scalar>> /*part*/) {
  return {};
}

template <class Scalar>
typename control::DahlFeedforward<Scalar>::Parameters parameters(
    const ControlDesign& design, Type<control::DahlFeedforward<Scalar>> /*part*/) {
  const numeric::Split<double> force = numeric::split(design.contact_force);
  return {{scaled<Scalar>(force.mantissa), force.exponent}};
}

template <class Scalar>
typename control::NoSlewLimit<Scalar>::Parameters parameters(
    const ControlDesign& /*design*/, Type<control::NoSlewLimit<Scalar>> /*part*/) {
  return {};
}

template <class Scalar>
typename control::SlewLimit<Scalar>::Parameters parameters(
    const ControlDesign& design, Type<control::SlewLimit<Scalar>> /*part*/) {
  return {design.slew_limited ? scaled<Scalar>(design.slew_per_period)
                              : numeric::from_code<Scalar>(INT32_MAX)};
}

template <class Scalar>
typename control::NoShaping<Scalar>::Parameters parameters(
    const ControlDesign& /*design*/, Type<control::NoShaping<Scalar>> /*part*/) {
  return {};
}

template <class Scalar, int MaxSpacing>
typename control::NotchShaper<Scalar, MaxSpacing>::Parameters parameters(
    const ControlDesign& design, Type<control::NotchShaper<Scalar, MaxSpacing>> /*part*/) {
  const auto& taps = design.notch_taps;
  return {{scaled<Scalar>(taps[0]), scaled<Scalar>(taps[1]), scaled<Scalar>(taps[2])},
          design.notch_spacing};
}

template <class Scalar>
typename control::NoRelearning<Scalar>::Parameters parameters(
    const ControlDesign& /*design*/, Type<control::NoRelearning<Scalar>> /*part*/) {
  return {};
}

template <class Scalar>
typename control::PeriodicRelearning<Scalar>::Parameters parameters(
    const ControlDesign& design, Type<control::PeriodicRelearning<Scalar>> /*part*/) {
  if (!design.relearns) {
    return {control::PeriodicRelearning<Scalar>::never, 0, {}, 1, 0, 1, {}};
  }
  return {design.relearn_every_periods,
          design.relearn_quiet_periods,
          scaled<Scalar>(design.relearn_travel),
          design.relearn_reading_periods,
          design.relearn_return_periods,
          design.relearn_average_periods,
          scaled<numeric::Accumulator<Scalar>>(design.relearn_weight)};
}

template <class Parts>
typename control::Controller<Parts>::Parameters controller_parameters(const ControlDesign& design) {
  using Scalar = typename Parts::Scalar;
  return {scaled<Scalar>(design.friction_force),
          scaled<Scalar>(design.smallest_friction),
          scaled<Scalar>(design.speed_floor),
          scaled<Scalar>(design.lead_periods / 64.0),
          parameters(design, Type<typename Parts::Friction>{}),
          parameters(design, Type<typename Parts::Feedforward>{}),
          parameters(design, Type<typename Parts::Slew>{}),
          parameters(design, Type<typename Parts::Shaper>{}),
          {scaled<Scalar>(design.integral_gain), scaled<Scalar>(design.reference_keep),
           design.hold_periods, design.rest_periods, design.reference_delay_periods},
          parameters(design, Type<typename Parts::Relearning>{}),
          {design.standstill_hold_periods, scaled<Scalar>(design.standstill_fall)},
          {design.stuck_periods},
          {design.implausible_periods},
          {scaled<Scalar>(design.settling_band), design.settling_patience_periods,
           scaled<Scalar>(design.agreement)},
          {},
          {}};
}

template <class Parts>
class InProcessControl final : public ControlPort {
 public:
  explicit InProcessControl(const ControlDesign& design)
      : controller_(controller_parameters<Parts>(design)), loop_(controller_, board_) {
    controller_.start();
  }

  void set_target(double friction_ratio) override {
    controller_.set_target(scaled<typename Parts::Scalar>(0.5 * friction_ratio));
  }

  hal::Drive exchange(const hal::Sample& sample) override {
    const numeric::LedgerScope scope(ledger_);
    board_.post(sample);
    loop_.serve();
    return board_.latest_drive();
  }

  std::vector<numeric::SignalRecord> signals() const override {
    return {ledger_.signals.begin(),
            ledger_.signals.begin() + static_cast<std::ptrdiff_t>(ledger_.size)};
  }

 private:
  using Controller = control::Controller<Parts>;

  Controller controller_;
  hal::host::SimulatedBoard board_;
  app::ControlLoop<Controller, hal::host::SimulatedBoard> loop_;
  numeric::SignalLedger ledger_;
};

// A scene's choice of each part, made once, before the loop.

template <class Scalar>
using FrictionChoice =
    std::variant<Type<control::TrustedFriction<Scalar>>, Type<control::LearntFriction<Scalar>>>;
template <class Scalar>
using FeedforwardChoice =
    std::variant<Type<control::CoulombFeedforward<Scalar>>, Type<control::DahlFeedforward<Scalar>>>;
template <class Scalar>
using LongNotch = control::NotchShaper<Scalar, configure::max_notch_spacing>;
template <class Scalar>
using ShaperChoice = std::variant<Type<control::NoShaping<Scalar>>, Type<LongNotch<Scalar>>>;

/// Few scenes name a slew limit or relearning: they share compositions that have both, the one that
/// a scene does not name being wide open. The commands are the same, bit for bit.
template <class SlewT, class RelearningT>
struct Extras {
  using Slew = SlewT;
  using Relearning = RelearningT;
};
template <class Scalar>
using ExtrasChoice =
    std::variant<Type<Extras<control::NoSlewLimit<Scalar>, control::NoRelearning<Scalar>>>,
                 Type<Extras<control::SlewLimit<Scalar>, control::PeriodicRelearning<Scalar>>>>;

/// The second alternative where `second`, else the first.
template <class Choice>
Choice choose(bool second) {
  if (second) {
    return std::variant_alternative_t<1, Choice>{};
  }
  return std::variant_alternative_t<0, Choice>{};
}

}  // namespace compose

template <class Scalar>
std::unique_ptr<ControlPort> make_control(const scene::Scene& scene,
                                          const configure::ControlDesign& design) {
  using namespace compose;
  return std::visit(
      [&](auto friction, auto feedforward, auto shaper,
          auto extras) -> std::unique_ptr<ControlPort> {
        using Chosen = typename decltype(extras)::type;
        using Parts =
            control::Parts<Scalar, typename decltype(friction)::type,
                           typename decltype(feedforward)::type, typename Chosen::Slew,
                           typename decltype(shaper)::type,
                           control::IntegralRegulator<Scalar, configure::max_reference_delay>,
                           typename Chosen::Relearning>;
        return std::make_unique<InProcessControl<Parts>>(design);
      },
      choose<FrictionChoice<Scalar>>(design.calibrated),
      choose<FeedforwardChoice<Scalar>>(scene::friction_map(scene.friction.law) ==
                                        scene::FrictionMap::dahl),
      choose<ShaperChoice<Scalar>>(design.shaped),
      choose<ExtrasChoice<Scalar>>(design.slew_limited || design.relearns));
}

}  // namespace sonoglide::loop
