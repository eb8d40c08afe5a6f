/// The controller of a scene in this process: the control loop of an image, on a simulated board.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <type_traits>
#include <vector>

#include "firmware/app/control_loop.hpp"
#include "firmware/control/controller.hpp"
#include "firmware/numeric/signal_ledger.hpp"
#include "hal/host/simulated_board.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/configure/controller_parameters.hpp"
#include "host_sim/loop/control_port.hpp"
#include "host_sim/loop/friction_belief.hpp"
#include "host_sim/loop/own_texture.hpp"

namespace sonoglide::loop {

template <class Parts>
class InProcess : public ControlPort {
  using Controller = control::Controller<Parts>;
  using Scalar = typename Parts::Scalar;

 public:
  using Sample = app::SampleOf<Controller>;
  using Drive = app::DriveOf<Controller>;

  explicit InProcess(const configure::ControlDesign& design)
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

  configure::ControlDesign design_;
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
std::unique_ptr<ControlPort> in_process(const configure::ControlDesign& design) {
  using Drive = app::DriveOf<control::Controller<Parts>>;
  if constexpr (std::is_same_v<Drive, hal::BiasedDrive>) {
    return std::make_unique<InProcessBiasedControl<Parts>>(design);
  } else {
    return std::make_unique<InProcessControl<Parts>>(design);
  }
}

}  // namespace sonoglide::loop
