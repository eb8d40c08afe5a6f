/// The controller of a scene in this process: the control loop of an image, on a simulated board.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "firmware/app/control_loop.hpp"
#include "firmware/app/texture.hpp"
#include "firmware/control/controller.hpp"
#include "firmware/numeric/signal_ledger.hpp"
#include "hal/host/simulated_board.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/configure/controller_parameters.hpp"
#include "host_sim/loop/control/control_port.hpp"
#include "host_sim/loop/control/friction_belief.hpp"

namespace sonoglide::loop {

/// Whether a vibration leads the frequency of its drive.
template <class Vibration, class = void>
inline constexpr bool leads_frequency = false;
template <class Vibration>
inline constexpr bool leads_frequency<
    Vibration, std::void_t<decltype(std::declval<const Vibration&>().next_frequency())>> = true;

/// How long the steps of a controller are.
template <class Vibration>
auto steps_of(const configure::ControlDesign& design) {
  if constexpr (leads_frequency<Vibration>) {
    return app::WordedSteps{design.texture->weight, design.resonance()->start_word};
  } else {
    return app::EqualSteps{design.texture->weight};
  }
}

/// The length of its period is in the numbers of the path.
struct AnyPeriod {};

template <class Scalar, class Vibration>
class OwnTexture {
  using Targets =
      app::TextureTargets<Scalar, decltype(steps_of<Vibration>(configure::ControlDesign{})),
                          AnyPeriod>;
  using Schedule = decltype(app::schedule_of(std::declval<const Targets&>()));

 public:
  explicit OwnTexture(const configure::ControlDesign& design)
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
  static std::vector<Scalar> points(const configure::ControlDesign& design) {
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
    if constexpr (numeric::IsCounted<Scalar>::value) {
      const numeric::LedgerScope scope(ledger_);
      return served(sample);
    } else {
      return served(sample);
    }
  }

 private:
  Drive served(const Sample& sample) {
    board_.post(sample);
    if (texture_) {
      texture_->schedule().advance(controller_);
      loop_.serve(texture_->schedule());
    } else {
      loop_.serve();
    }
    return board_.latest_drive();
  }

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
