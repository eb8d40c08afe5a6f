/// A velocity sensor that stands still, in example scenes.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "firmware/control/interface/drive_command.hpp"
#include "hal/board.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/loop/control/control_port.hpp"
#include "host_sim/loop/run.hpp"
#include "tests/scene_units/agreement/scene_unit.hpp"

namespace sonoglide::app::scene_units_test {
namespace {

using Port = PortOf<hal::Sample, hal::Drive>;

/// A velocity sensor that stands still from some period on.
class StuckVelocity : public Port {
 public:
  StuckVelocity(ControlPort& port, std::size_t from) : port_(port), left_(from) {}

  void set_target(double friction_ratio) override { port_.set_target(friction_ratio); }

 private:
  hal::Drive answer(const hal::Sample& sample) override {
    if (left_ > 0) {
      --left_;
      velocity_ = sample.sliding_velocity;
    }
    hal::Sample shown = sample;
    shown.sliding_velocity = velocity_;
    return port_.exchange(shown);
  }

  ControlPort& port_;
  std::size_t left_;
  std::int32_t velocity_ = 0;
};

/// The commands where the velocity stands still from a period on.
std::vector<hal::Drive> drives_with_stuck_velocity(const std::string& name, std::size_t from) {
  const scene::Scene scene = experiment::read_file(SONOGLIDE_SCENES "/" + name + ".toml").plant;
  const auto control = loop::make_control_port(scene, configure::design_control(scene));
  Recorded<Port> recorded(*control);
  StuckVelocity stuck(recorded, from);
  loop::run(scene, configure::design_control(scene), stuck);
  return recorded.drives;
}

// The sliding of the scene turns in period 240.
TEST(StuckVelocity, IsNamedWhereTheSlidingTurns) {
  for (const std::size_t from : {30U, 120U, 200U}) {
    const std::vector<hal::Drive> drives = drives_with_stuck_velocity("speed_reversal", from);
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
  const std::vector<hal::Drive> drives = drives_with_stuck_velocity("stop_and_start", 120);
  for (std::size_t i = 245; i < 360; ++i) {
    ASSERT_EQ(drives[i].state, static_cast<std::uint8_t>(control::State::limited)) << i;
    ASSERT_LE(drives[i].amplitude, drives[120].amplitude) << i;
  }
}

}  // namespace
}  // namespace sonoglide::app::scene_units_test
