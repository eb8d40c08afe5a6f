/// A unit of a scene does what `run` does, command by command; and a restart is like new. One with a texture
/// follows it as `run` does; its place goes on whatever the unit does.
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "firmware/app/exchange.hpp"
#include "firmware/app/field_parameters.hpp"
#include "firmware/app/target_schedule.hpp"
#include "firmware/app/texture.hpp"
#include "firmware/app/unit.hpp"
#include "hal/board.hpp"
#include "hal/timed/volatile_pages.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/loop/control/control_port.hpp"
#include "host_sim/loop/run.hpp"
#include "tests/scene_units/agreement/ports.hpp"

namespace sonoglide::app::scene_units_test {

using Pages = hal::timed::VolatilePages;

/// FieldDesign of the controller that is compiled in as a namespace.
#define SONOGLIDE_FIELD_DESIGN(configured)                                                       \
  FieldDesign<configured::Parts>(configured::parameters, first_target(configured::target_steps), \
                                 configured::design, configured::full_scales,                    \
                                 configured::step_period_s, 0)

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

/// Of the board of a unit in a test, who has no encoder.
struct NoEncoder {};

/// One carrier period.
template <class UnitT, class Sample, class Board>
const typename UnitT::Supervisor::Drive& step(UnitT& unit, Sample sample, Board& board) {
  unit.supervisor().note_service();
  unit.supervisor().calibrate(sample);
  const auto& drive = unit.supervisor().step(sample);
  unit.supervisor().pass(sample, board);
  return drive;
}
template <class UnitT, class Sample>
const typename UnitT::Supervisor::Drive& step(UnitT& unit, const Sample& sample) {
  NoEncoder board;
  return step(unit, sample, board);
}

/// A unit that was told to start, and that is sent each target. Its service never ends.
///
/// @tparam Board  hands over its count, if it has an encoder
template <class Parts, class Course = OrderedTargets, class Board = NoEncoder>
class UnitPort : public PortOfParts<Parts> {
  using Base = PortOfParts<Parts>;

 public:
  /// @param full_scale  of a target: 1 of a friction ratio, of a force that of its sensor [N]
  UnitPort(const FieldDesign<Parts>& design, double full_scale, const Course& course = Course())
      : full_scale_(full_scale), unit(design, pages_, course) {
    restart(unit);
  }

  void set_target(double target) override {
    const auto millionths = static_cast<std::uint32_t>(std::lround(1e6 * target / full_scale_));
    EXPECT_EQ(unit.set_target(millionths, unit.supervisor().faults().count()), Answer::taken);
  }

 private:
  typename Base::Drive answer(const typename Base::Sample& sample) override {
    return step(unit, sample, board);
  }

  Pages pages_;
  double full_scale_;

 public:
  Board board;
  Unit<Parts, Pages, std::atomic, 0, Course> unit;
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
    drives.push_back(step(unit, sample));
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

/// A controller beside the place on its texture, which moves whether the controller runs or not.
template <class Parts, class Targets>
class Textured {
  using Design = FieldDesign<Parts>;
  using Scalar = typename Parts::Scalar;

 public:
  using Drive = DriveOf<typename Design::Controller>;

  Textured(const Design& design, const Targets& targets)
      : controller_(design.controller_parameters(design.presets())),
        schedule_(schedule_of(targets)) {
    controller_.settle_at(design.designed());
  }
  void start() { controller_.start(); }
  void stop() { controller_.stop(); }
  void skip() { schedule_.next(controller_); }

  template <class Sample>
  Drive step(const Sample& sample) {
    NoEncoder board;
    const Scalar there = schedule_.next(controller_);
    controller_.set_target(ordered_ == Scalar{} ? there : ordered_);
    const Drive drive = drive_of(
        controller_.template step<control::Numbers::finite>(measurement_of<Scalar>(sample)));
    schedule_.pass(sample, board);
    return drive;
  }
  template <class Sample>
  void pass(const Sample& sample) {
    NoEncoder board;
    skip();
    schedule_.pass(sample, board);
  }
  void order(Scalar target) { ordered_ = target; }

 private:
  typename Design::Controller controller_;
  decltype(schedule_of(std::declval<const Targets&>())) schedule_;
  Scalar ordered_{};
};

/// Orders a target, which is in force in the carrier period of the sample.
template <class UnitT, class Sample>
auto step_with_target(UnitT& unit, std::uint32_t millionths, const Sample& sample) {
  EXPECT_EQ(unit.set_target(millionths, unit.supervisor().faults().count()), Answer::taken);
  const auto drive = step(unit, sample);
  EXPECT_EQ(unit.order_end(), OrderEnd::done);
  EXPECT_EQ(unit.target(), millionths);
  return drive;
}

/// Through a run, a stop, a run again, a target of the host's and the texture again.
template <class Parts, class Targets, class Sample>
void expect_texture_goes_on(const FieldDesign<Parts>& design, const Targets& targets,
                            const std::vector<Sample>& samples) {
  UnitPort port(design, 1.0, course_of<void>(targets));
  Textured<Parts, Targets> expected(design, targets);
  expected.skip();  // the period of the restart has no sample
  expected.start();
  std::vector<typename Textured<Parts, Targets>::Drive> found;
  std::vector<typename Textured<Parts, Targets>::Drive> wanted;
  const auto run = [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      wanted.push_back(expected.step(samples[i]));
      found.push_back(step(port.unit, samples[i]));
    }
  };
  const std::size_t part = samples.size() / 4;
  EXPECT_EQ(port.unit.target(), 0U);
  run(0, part);
  // It stands, and the sliding goes on; of the restart's period only the place counts.
  port.unit.stop();
  for (std::size_t i = part; i < 2 * part; ++i) {
    expected.pass(samples[i]);
    if (i == part) {
      expected.stop();
    }
    EXPECT_EQ(step(port.unit, samples[i]).amplitude, 0);
  }
  EXPECT_EQ(port.unit.restart(0), Answer::taken);
  expected.pass(samples[2 * part]);
  expected.start();
  step(port.unit, samples[2 * part]);
  EXPECT_EQ(port.unit.order_end(), OrderEnd::done);
  run(2 * part + 1, 3 * part);
  const auto order = [&](std::uint32_t millionths, std::size_t i) {
    expected.order(design.target(millionths));
    wanted.push_back(expected.step(samples[i]));
    found.push_back(step_with_target(port.unit, millionths, samples[i]));
  };
  order(300'000, 3 * part);
  run(3 * part + 1, 3 * part + part / 2);
  order(0, 3 * part + part / 2);
  run(3 * part + part / 2 + 1, samples.size());
  expect_same(found, wanted);
}

/// @param changes  TABLE.KEY=VALUE, of the scene
/// @param targets  as they are compiled in
template <class Parts, class Targets>
void expect_unit_and_run_agree(const std::string& file, const std::vector<std::string>& changes,
                               const FieldDesign<Parts>& design, const Targets& targets) {
  const configure::Experiment experiment = experiment::read_file(file, changes);
  const scene::Scene& scene = experiment.plant;
  const auto control = loop::make_control_port(experiment.nominal, *experiment.design);
  Recorded<PortOfParts<Parts>> run(*control);
  const loop::RunResult by_run = loop::run(scene, *experiment.design, run);
  const auto course = course_of<void>(targets);
  UnitPort port(design, scene.highest_target(), course);
  Recorded<PortOfParts<Parts>> unit(port);
  const loop::RunResult by_unit = loop::run(scene, *experiment.design, unit);
  expect_same(unit.drives, run.drives);
  EXPECT_EQ(by_unit.control->trace_hash, by_run.control->trace_hash);
  if (scene.controller->texture) {
    if constexpr (!std::is_same_v<decltype(course), const OrderedTargets>) {
      expect_texture_goes_on(design, targets, run.samples);
    }
    return;
  }
  expect_drive_limit_holds(design, run.samples);
  UnitPort fresh(design, scene.highest_target(), course);
  // After a stop and after a fault it is as one that has never run.
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
