/// Ports of the simulation to a controller whose parts are compiled in.
#pragma once

#include <vector>

#include "firmware/app/exchange.hpp"
#include "firmware/control/controller.hpp"
#include "hal/board.hpp"
#include "host_sim/loop/control/control_port.hpp"

namespace sonoglide::app::scene_units_test {

/// A port of one kind of samples and answers.
template <class SampleT, class DriveT>
class PortOf : public loop::ControlPort {
 public:
  using Sample = SampleT;
  using Drive = DriveT;

  Drive exchange(const Sample& sample) final { return answer(sample); }
  std::vector<numeric::SignalRecord> signals() const final { return {}; }

 protected:
  static Drive ask(ControlPort& port, const Sample& sample) { return port.exchange(sample); }
  virtual Drive answer(const Sample& sample) = 0;
};

template <class SampleT>
class PortOf<SampleT, hal::BiasedDrive> : public loop::ControlPort {
 public:
  using Sample = SampleT;
  using Drive = hal::BiasedDrive;

  Drive exchange_biased(const Sample& sample) final { return answer(sample); }
  std::vector<numeric::SignalRecord> signals() const final { return {}; }

 protected:
  static Drive ask(ControlPort& port, const Sample& sample) { return port.exchange_biased(sample); }
  virtual Drive answer(const Sample& sample) = 0;
};

/// Keeps what passes.
template <class Base>
class Recorded : public Base {
 public:
  explicit Recorded(loop::ControlPort& port) : port_(port) {}

  void set_target(double target) override { port_.set_target(target); }

  std::vector<typename Base::Sample> samples;
  std::vector<typename Base::Drive> drives;

 private:
  typename Base::Drive answer(const typename Base::Sample& sample) override {
    samples.push_back(sample);
    drives.push_back(Base::ask(port_, sample));
    return drives.back();
  }

  loop::ControlPort& port_;
};

template <class Parts>
using PortOfParts =
    PortOf<SampleOf<control::Controller<Parts>>, DriveOf<control::Controller<Parts>>>;

}  // namespace sonoglide::app::scene_units_test
