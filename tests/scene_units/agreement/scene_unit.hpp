/// A unit of a scene does what `run` does, command by command; and a restart is like new.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <type_traits>
#include <vector>

#include "firmware/app/exchange.hpp"
#include "firmware/app/field_parameters.hpp"
#include "firmware/app/unit.hpp"
#include "hal/board.hpp"
#include "hal/timed/volatile_pages.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/loop/control_port.hpp"
#include "host_sim/loop/run.hpp"

namespace sonoglide::app::scene_units_test {

using Pages = hal::timed::VolatilePages;

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

/// A carrier period without a sample, for a stop or an order of a unit that does not drive.
template <class UnitT>
void pass(UnitT& unit) {
  unit.supervisor().step({});
  EXPECT_EQ(unit.order_end(), OrderEnd::done);
}

/// Orders a restart, and lets its carrier period pass.
template <class UnitT>
void restart(UnitT& unit) {
  EXPECT_EQ(unit.restart(unit.supervisor().faults().count()), Answer::taken);
  pass(unit);
}

template <class Parts>
using PortOfParts =
    PortOf<SampleOf<control::Controller<Parts>>, DriveOf<control::Controller<Parts>>>;

/// A unit that was told to start, and that is sent each target. Its service never ends.
template <class Parts>
class UnitPort : public PortOfParts<Parts> {
  using Base = PortOfParts<Parts>;

 public:
  /// @param full_scale  of a target: 1 of a friction ratio, of a force that of its sensor [N]
  UnitPort(const FieldDesign<Parts>& design, double full_scale)
      : full_scale_(full_scale), unit(design, pages_) {
    restart(unit);
  }

  void set_target(double target) override {
    const auto millionths = static_cast<std::uint32_t>(std::lround(1e6 * target / full_scale_));
    EXPECT_EQ(unit.set_target(millionths, unit.supervisor().faults().count()), Answer::taken);
  }

 private:
  typename Base::Drive answer(const typename Base::Sample& sample) override {
    unit.supervisor().note_service();
    return unit.supervisor().step(sample);
  }

  Pages pages_;
  double full_scale_;

 public:
  Unit<Parts, Pages> unit;
};

template <class Drive>
bool same(const Drive& a, const Drive& b) {
  bool equal = a.amplitude == b.amplitude && a.commanded_ratio == b.commanded_ratio &&
               a.state == b.state && a.limit == b.limit && a.fault == b.fault &&
               a.settling == b.settling;
  if constexpr (std::is_same_v<Drive, hal::ResonantDrive>) {
    equal = equal && a.frequency == b.frequency;
  } else if constexpr (std::is_same_v<Drive, hal::BiasedDrive>) {
    equal = equal && a.bias == b.bias;
  }
  return equal;
}

template <class Drive>
void expect_same(const std::vector<Drive>& found, const std::vector<Drive>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    ASSERT_TRUE(same(found[i], expected[i]))
        << "period " << i << ": amplitude " << found[i].amplitude << " for "
        << expected[i].amplitude << ", ratio " << found[i].commanded_ratio << " for "
        << expected[i].commanded_ratio << ", state " << int{found[i].state} << " for "
        << int{expected[i].state};
  }
}

/// What a unit answers to samples after a restart.
template <class UnitT, class Sample>
auto answers(UnitT& unit, const std::vector<Sample>& samples) {
  restart(unit);
  std::vector<typename UnitT::Supervisor::Drive> drives;
  for (const Sample& sample : samples) {
    unit.supervisor().note_service();
    drives.push_back(unit.supervisor().step(sample));
  }
  return drives;
}

/// In amplitude, of either sign.
template <class Parts, class Sample>
void expect_drive_limit_holds(const FieldDesign<Parts>& design,
                              const std::vector<Sample>& samples) {
  ParameterValues values = design.presets();
  values[static_cast<std::size_t>(Parameter::drive_limit)] = 300'000;
  const auto parameters = design.controller_parameters(values);
  typename FieldDesign<Parts>::Controller controller(parameters);
  controller.start();
  controller.set_target(design.target(values[static_cast<std::size_t>(Parameter::target)]));
  for (const Sample& sample : samples) {
    const auto drive = drive_of(controller.step(measurement_of<typename Parts::Scalar>(sample)));
    ASSERT_LE(std::abs(std::int64_t{drive.amplitude}), std::int64_t{644245094});  // 0.3
  }
}

/// @param changes  TABLE.KEY=VALUE, of the scene
template <class Parts>
void expect_unit_and_run_agree(const std::string& file, const std::vector<std::string>& changes,
                               const FieldDesign<Parts>& design) {
  const configure::Experiment experiment = experiment::read_file(file, changes);
  const scene::Scene& scene = experiment.plant;
  const auto control = loop::make_control_port(experiment.nominal, *experiment.design);
  Recorded<PortOfParts<Parts>> run(*control);
  const loop::RunResult by_run = loop::run(scene, *experiment.design, run);
  UnitPort<Parts> port(design, scene.highest_target());
  Recorded<PortOfParts<Parts>> unit(port);
  const loop::RunResult by_unit = loop::run(scene, *experiment.design, unit);
  expect_same(unit.drives, run.drives);
  EXPECT_EQ(by_unit.control->trace_hash, by_run.control->trace_hash);
  expect_drive_limit_holds(design, run.samples);
  // After a stop and after a fault it is as one that has never run.
  UnitPort<Parts> fresh(design, scene.highest_target());
  fresh.unit.stop();
  pass(fresh.unit);
  fresh.set_target(scene.controller->targets().back().value);
  pass(fresh.unit);
  const auto first = answers(fresh.unit, run.samples);
  port.unit.stop();
  pass(port.unit);
  expect_same(answers(port.unit, run.samples), first);
  port.unit.supervisor().step({});
  EXPECT_EQ(port.unit.supervisor().drive().state, static_cast<std::uint8_t>(control::State::fault));
  expect_same(answers(port.unit, run.samples), first);
}

}  // namespace sonoglide::app::scene_units_test
