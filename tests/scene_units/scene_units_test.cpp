/// A unit of a scene does what `run` does, command by command; and a restart is like new.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "controllers_of_scenes.hpp"
#include "firmware/app/field_parameters.hpp"
#include "firmware/app/unit.hpp"
#include "hal/board.hpp"
#include "hal/timed/volatile_pages.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/loop/control_port.hpp"
#include "host_sim/loop/run.hpp"

namespace sonoglide::app::scene_units_test {
namespace {

using Pages = hal::timed::VolatilePages;
using Drives = std::vector<hal::Drive>;

/// Keeps what passes.
class Recorded : public loop::ControlPort {
 public:
  explicit Recorded(ControlPort& port) : port_(port) {}

  void set_target(double friction_ratio) override { port_.set_target(friction_ratio); }
  hal::Drive exchange(const hal::Sample& sample) override {
    samples.push_back(sample);
    drives.push_back(port_.exchange(sample));
    return drives.back();
  }
  std::vector<numeric::SignalRecord> signals() const override { return {}; }

  std::vector<hal::Sample> samples;
  Drives drives;

 private:
  ControlPort& port_;
};

/// A carrier period without a sample, for a stop or an order of a unit that does not drive.
template <class UnitT>
void pass(UnitT& unit) {
  unit.supervisor().step({0, 0, false, false});
  EXPECT_EQ(unit.order_end(), OrderEnd::done);
}

/// Orders a restart, and lets its carrier period pass.
template <class UnitT>
void restart(UnitT& unit) {
  EXPECT_EQ(unit.restart(unit.supervisor().faults().count()), Answer::taken);
  pass(unit);
}

/// A unit that was told to start, and that is sent each target. Its service never ends.
template <class Parts>
class UnitPort : public loop::ControlPort {
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
  hal::Drive exchange(const hal::Sample& sample) override {
    unit.supervisor().note_service();
    return unit.supervisor().step(sample);
  }
  std::vector<numeric::SignalRecord> signals() const override { return {}; }

 private:
  Pages pages_;
  double full_scale_;

 public:
  Unit<Parts, Pages> unit;
};

bool same(const hal::Drive& a, const hal::Drive& b) {
  return a.amplitude == b.amplitude && a.commanded_ratio == b.commanded_ratio &&
         a.state == b.state && a.limit == b.limit && a.fault == b.fault && a.settling == b.settling;
}

void expect_same(const Drives& found, const Drives& expected) {
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
template <class UnitT>
Drives answers(UnitT& unit, const std::vector<hal::Sample>& samples) {
  restart(unit);
  Drives drives;
  for (const hal::Sample& sample : samples) {
    unit.supervisor().note_service();
    drives.push_back(unit.supervisor().step(sample));
  }
  return drives;
}

template <class Parts>
void expect_unit_and_run_agree(const std::string& name, const FieldDesign<Parts>& design) {
  const scene::Scene scene = experiment::read_file(SONOGLIDE_SCENES "/" + name + ".toml").plant;
  const auto control = loop::make_control_port(scene, configure::design_control(scene));
  Recorded run(*control);
  const loop::RunResult by_run = loop::run(scene, configure::design_control(scene), run);
  UnitPort<Parts> port(design, scene.highest_target());
  Recorded unit(port);
  const loop::RunResult by_unit = loop::run(scene, configure::design_control(scene), unit);
  expect_same(unit.drives, run.drives);
  EXPECT_EQ(by_unit.control->trace_hash, by_run.control->trace_hash);
  // After a stop and after a fault it is as one that has never run.
  UnitPort<Parts> fresh(design, scene.highest_target());
  fresh.unit.stop();
  pass(fresh.unit);
  fresh.set_target(scene.controller->targets().back().value);
  pass(fresh.unit);
  const Drives first = answers(fresh.unit, run.samples);
  port.unit.stop();
  pass(port.unit);
  expect_same(answers(port.unit, run.samples), first);
  port.unit.supervisor().step({0, 0, false, false});
  EXPECT_EQ(port.unit.supervisor().drive().fault,
            static_cast<std::uint8_t>(control::Fault::measurement_missing));
  expect_same(answers(port.unit, run.samples), first);
}

#define SONOGLIDE_TEST_OF_UNIT(name)                                                        \
  constexpr FieldDesign<scene_##name::Parts> name(                                          \
      scene_##name::parameters, scene_##name::target_steps[0].target, scene_##name::design, \
      scene_##name::step_period_s, 0);                                                      \
  TEST(UnitOfScene, name) {                                                                 \
    expect_unit_and_run_agree(#name, name);                                                 \
  }

SONOGLIDE_UNITS_OF_SCENES(SONOGLIDE_TEST_OF_UNIT)

/// A velocity sensor that stands still from some period on.
class StuckVelocity : public loop::ControlPort {
 public:
  StuckVelocity(ControlPort& port, std::size_t from) : port_(port), left_(from) {}

  void set_target(double friction_ratio) override { port_.set_target(friction_ratio); }
  hal::Drive exchange(const hal::Sample& sample) override {
    if (left_ > 0) {
      --left_;
      velocity_ = sample.sliding_velocity;
    }
    hal::Sample shown = sample;
    shown.sliding_velocity = velocity_;
    return port_.exchange(shown);
  }
  std::vector<numeric::SignalRecord> signals() const override { return {}; }

 private:
  ControlPort& port_;
  std::size_t left_;
  std::int32_t velocity_ = 0;
};

/// The commands where the velocity stands still from a period on.
Drives drives_with_stuck_velocity(const std::string& name, std::size_t from) {
  const scene::Scene scene = experiment::read_file(SONOGLIDE_SCENES "/" + name + ".toml").plant;
  const auto control = loop::make_control_port(scene, configure::design_control(scene));
  Recorded recorded(*control);
  StuckVelocity stuck(recorded, from);
  loop::run(scene, configure::design_control(scene), stuck);
  return recorded.drives;
}

// The sliding of the scene turns in period 240.
TEST(StuckVelocity, IsNamedWhereTheSlidingTurns) {
  for (const std::size_t from : {30U, 120U, 200U}) {
    const Drives drives = drives_with_stuck_velocity("speed_reversal", from);
    ASSERT_EQ(drives.size(), 480U);
    for (std::size_t i = 240 + 40; i < drives.size(); ++i) {
      ASSERT_EQ(drives[i].fault, static_cast<std::uint8_t>(control::Fault::velocity_stuck)) << i;
      ASSERT_EQ(drives[i].amplitude, 0) << i;
    }
    EXPECT_EQ(drives[240].fault, 0);
  }
}

// Friction is lower than the target at every drive: the weakest is commanded, and that is named.
TEST(StuckVelocity, LeavesTheDriveLowAndLimitedWhereTheSlidingStops) {
  const Drives drives = drives_with_stuck_velocity("stop_and_start", 120);
  for (std::size_t i = 245; i < 360; ++i) {
    ASSERT_EQ(drives[i].state, static_cast<std::uint8_t>(control::State::limited)) << i;
    ASSERT_LE(drives[i].amplitude, drives[120].amplitude) << i;
  }
}

}  // namespace
}  // namespace sonoglide::app::scene_units_test
