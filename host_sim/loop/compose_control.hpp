/// The controller of a scene, composed with every part that it may name.
#pragma once

#include <cstddef>
#include <memory>
#include <variant>
#include <vector>

#include "firmware/app/control_loop.hpp"
#include "firmware/control/controller.hpp"
#include "hal/host/simulated_board.hpp"
#include "host_sim/configure/controller_parameters.hpp"
#include "host_sim/configure/controller_parts.hpp"
#include "host_sim/loop/control_port.hpp"

namespace sonoglide::loop {
namespace compose {

using configure::ControlDesign;

template <class Parts>
class InProcessControl final : public ControlPort {
 public:
  explicit InProcessControl(const ControlDesign& design)
      : controller_(configure::controller_parameters<Parts>(design)), loop_(controller_, board_) {
    controller_.start();
  }

  void set_target(double friction_ratio) override {
    controller_.set_target(configure::half_target<typename Parts::Scalar>(friction_ratio));
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

/// Few scenes name a slew limit or relearning: they share compositions that have both, the one that
/// a scene does not name being wide open. Every composition has a regulator, whose gain is 0 where
/// there is no feedback. The commands are those of the leanest parts, bit for bit.
template <class SlewT, class RelearningT>
struct Extras {
  using Slew = SlewT;
  using Relearning = RelearningT;
};
template <class Scalar>
using ExtrasChoice =
    configure::Choice<Extras<control::NoSlewLimit<Scalar>, control::NoRelearning<Scalar>>,
                      Extras<control::SlewLimit<Scalar>, control::PeriodicRelearning<Scalar>>>;

}  // namespace compose

template <class Scalar>
std::unique_ptr<ControlPort> make_control(const configure::ControlDesign& design) {
  using namespace compose;
  const configure::ControllerParts<Scalar> parts(design);
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
      parts.friction, parts.feedforward, parts.shaper,
      configure::choose<ExtrasChoice<Scalar>>(design.slew_limited || design.relearns));
}

}  // namespace sonoglide::loop
