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
#include "firmware/control/slew_limit.hpp"
#include "firmware/control/trusted_friction.hpp"
#include "firmware/numeric/fixed.hpp"
#include "hal/host/simulated_board.hpp"
#include "host_sim/loop/control_port.hpp"
#include "host_sim/loop/type.hpp"

namespace sonoglide::loop {
namespace {

using scene::ControlDesign;

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
          scaled<numeric::Accumulator<Scalar>>(1.0 / design.calibration_average_periods)};
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
  return {scaled<Scalar>(design.slew_per_period)};
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

template <class Parts>
typename control::Controller<Parts>::Parameters controller_parameters(const ControlDesign& design) {
  using Scalar = typename Parts::Scalar;
  return {scaled<Scalar>(design.friction_force),
          scaled<Scalar>(design.speed_floor),
          scaled<Scalar>(design.lead_periods / 64.0),
          parameters(design, Type<typename Parts::Friction>{}),
          parameters(design, Type<typename Parts::Feedforward>{}),
          parameters(design, Type<typename Parts::Slew>{}),
          parameters(design, Type<typename Parts::Shaper>{}),
          {scaled<Scalar>(design.integral_gain), design.hold_periods},
          {design.stuck_periods}};
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
using SlewChoice =
    std::variant<Type<control::NoSlewLimit<Scalar>>, Type<control::SlewLimit<Scalar>>>;
template <class Scalar>
using LongNotch = control::NotchShaper<Scalar, scene::max_notch_spacing>;
template <class Scalar>
using ShaperChoice = std::variant<Type<control::NoShaping<Scalar>>, Type<LongNotch<Scalar>>>;

/// The second alternative where `second`, else the first.
template <class Choice>
Choice choose(bool second) {
  if (second) {
    return std::variant_alternative_t<1, Choice>{};
  }
  return std::variant_alternative_t<0, Choice>{};
}

template <class Scalar>
std::unique_ptr<ControlPort> make(const scene::Scene& scene, const ControlDesign& design) {
  return std::visit(
      [&](auto friction, auto feedforward, auto slew, auto shaper) -> std::unique_ptr<ControlPort> {
        using Parts =
            control::Parts<Scalar, typename decltype(friction)::type,
                           typename decltype(feedforward)::type, typename decltype(slew)::type,
                           typename decltype(shaper)::type, control::IntegralRegulator<Scalar>>;
        return std::make_unique<InProcessControl<Parts>>(design);
      },
      choose<FrictionChoice<Scalar>>(design.calibrated),
      choose<FeedforwardChoice<Scalar>>(scene::friction_map(scene.friction.law) ==
                                        scene::FrictionMap::dahl),
      choose<SlewChoice<Scalar>>(design.slew_limited), choose<ShaperChoice<Scalar>>(design.shaped));
}

}  // namespace

std::unique_ptr<ControlPort> make_control_port(const scene::Scene& scene,
                                               const ControlDesign& design) {
  switch (scene.controller->arithmetic) {
    case scene::Arithmetic::float32:
      return make<float>(scene, design);
    case scene::Arithmetic::q31:
      return make<numeric::Q31<numeric::Counting>>(scene, design);
    case scene::Arithmetic::q15:
      return make<numeric::Q15<numeric::Counting>>(scene, design);
    case scene::Arithmetic::float64:
      break;
  }
  return make<double>(scene, design);
}

}  // namespace sonoglide::loop
