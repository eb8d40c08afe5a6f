#include "firmware/app/control_loop.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "firmware/control/controller.hpp"
#include "firmware/control/feedback/integral_regulator.hpp"
#include "firmware/control/friction/coulomb_feedforward.hpp"
#include "firmware/control/friction/learnt_friction.hpp"
#include "firmware/control/limits/notch_shaper.hpp"
#include "firmware/control/limits/slew_limit.hpp"
#include "firmware/numeric/fixed.hpp"

namespace sonoglide::app::control_loop_test {
namespace {

constexpr std::int32_t highest = std::numeric_limits<std::int32_t>::max();
constexpr std::int32_t lowest = std::numeric_limits<std::int32_t>::min();

/// Keeps what it is told, answers what it was set to.
template <class ScalarT>
class RecordingController {
 public:
  using Scalar = ScalarT;
  using Measurement = control::Measurement<Scalar>;
  using Command = control::DriveCommand<Scalar>;

  template <control::Numbers Known>
  control::DriveCommand<Scalar> step(const control::Measurement<Scalar>& measurement) {
    told.push_back(measurement);
    return answer;
  }

  std::vector<control::Measurement<Scalar>> told;
  control::DriveCommand<Scalar> answer{};
};

/// Offers samples from a list, then shuts down.
class ScriptedBoard {
 public:
  explicit ScriptedBoard(std::vector<hal::Sample> samples) : samples_(std::move(samples)) {}

  bool sample(hal::Sample& sample) {
    if (next_ == samples_.size()) {
      return false;
    }
    sample = samples_[next_++];
    return true;
  }
  void drive(const hal::Drive& drive) { driven.push_back(drive); }

  std::vector<hal::Drive> driven;

 private:
  std::vector<hal::Sample> samples_;
  std::size_t next_ = 0;
};

template <class Scalar>
class ControlLoopTest : public testing::Test {
 protected:
  /// What the controller is told of one sample.
  static control::Measurement<Scalar> told(const hal::Sample& sample) {
    RecordingController<Scalar> controller;
    ScriptedBoard board({sample});
    EXPECT_TRUE(
        (ControlLoop<RecordingController<Scalar>, ScriptedBoard>(controller, board).serve()));
    EXPECT_EQ(controller.told.size(), 1U);
    return controller.told.front();
  }
  /// What the board is told of one command.
  static hal::Drive driven(const control::DriveCommand<Scalar>& command) {
    RecordingController<Scalar> controller;
    controller.answer = command;
    ScriptedBoard board({{0, 0, false, true}});
    EXPECT_TRUE(
        (ControlLoop<RecordingController<Scalar>, ScriptedBoard>(controller, board).serve()));
    EXPECT_EQ(board.driven.size(), 1U);
    return board.driven.front();
  }
};
using Scalars = testing::Types<double, float, numeric::Q31<numeric::Saturating>,
                               numeric::Q31<numeric::Trapping>>;
TYPED_TEST_SUITE(ControlLoopTest, Scalars);

TYPED_TEST(ControlLoopTest, CodesBecomePartsOfFullScale) {
  const auto measured = this->told({1 << 30, -(1 << 29), false, true});
  EXPECT_EQ(numeric::to_real(measured.friction_force), 0.5);
  EXPECT_EQ(numeric::to_real(measured.sliding_velocity), -0.25);
  EXPECT_EQ(measured.quality, control::Quality::good);
  const auto ends = this->told({highest, lowest, false, true});
  EXPECT_NEAR(numeric::to_real(ends.friction_force), 1.0, numeric::from_code<double>(1));
  EXPECT_EQ(numeric::to_real(ends.sliding_velocity), -1.0);
}

TYPED_TEST(ControlLoopTest, AForceAtTheRailIsSaturated) {
  EXPECT_EQ(this->told({highest, 0, true, true}).quality, control::Quality::saturated);
}

TYPED_TEST(ControlLoopTest, AVelocityAtTheRailIsNamedBesideTheForce) {
  for (const bool force_at_rail : {false, true}) {
    for (const bool velocity_at_rail : {false, true}) {
      const auto measured = this->told({0, highest, force_at_rail, true, velocity_at_rail});
      EXPECT_EQ(measured.velocity_at_rail, velocity_at_rail);
      EXPECT_EQ(measured.quality,
                force_at_rail ? control::Quality::saturated : control::Quality::good);
    }
  }
}

TYPED_TEST(ControlLoopTest, ASampleThatIsNotFreshIsMissing) {
  EXPECT_EQ(this->told({1 << 30, 0, false, false}).quality, control::Quality::missing);
  EXPECT_EQ(this->told({highest, 0, true, false}).quality, control::Quality::missing);
}

TYPED_TEST(ControlLoopTest, TheCommandReachesTheBoardAsCodes) {
  const auto half = numeric::from_real<TypeParam>(0.5);
  const hal::Drive drive =
      this->driven({half, half, control::State::limited, control::Limit::speed_floor,
                    control::Fault::none, control::Settling::settled});
  EXPECT_EQ(drive.amplitude, 1 << 30);
  EXPECT_EQ(drive.commanded_ratio, 1 << 30);
  EXPECT_EQ(drive.settling, 1);
  EXPECT_EQ(drive.state, 3);
  EXPECT_EQ(drive.limit, 3);
  EXPECT_EQ(drive.fault, 0);
  const hal::Drive gone =
      this->driven({TypeParam{}, half, control::State::fault, control::Limit::none,
                    control::Fault::measurement_saturated, control::Settling::pending});
  EXPECT_EQ(gone.amplitude, 0);
  EXPECT_EQ(gone.state, 4);
  EXPECT_EQ(gone.limit, 0);
  EXPECT_EQ(gone.fault, 18);
}

TYPED_TEST(ControlLoopTest, FullDriveIsTheHighestCode) {
  EXPECT_EQ(this->driven({numeric::from_code<TypeParam>(highest), {}, {}, {}, {}, {}}).amplitude,
            highest);
}

TYPED_TEST(ControlLoopTest, ServesUntilTheBoardShutsDown) {
  RecordingController<TypeParam> controller;
  ScriptedBoard board({{1, 1, false, true}, {2, 2, false, true}, {3, 3, false, true}});
  ControlLoop<RecordingController<TypeParam>, ScriptedBoard> loop(controller, board);
  int served = 0;
  while (loop.serve()) {
    ++served;
  }
  EXPECT_EQ(served, 3);
  EXPECT_EQ(controller.told.size(), 3U);
  EXPECT_EQ(board.driven.size(), 3U);
  EXPECT_FALSE(loop.serve());
  EXPECT_EQ(board.driven.size(), 3U);
}

// The real controller behind the seam: it runs, a lost sample takes the drive away at once.
TYPED_TEST(ControlLoopTest, ALostSampleEndsTheDriveInTheSameStep) {
  using Parts =
      control::Parts<TypeParam, control::TrustedFriction<TypeParam>,
                     control::CoulombFeedforward<TypeParam>, control::NoSlewLimit<TypeParam>,
                     control::NoShaping<TypeParam>, control::IntegralRegulator<TypeParam, 1>>;
  using Controller = control::Controller<Parts>;
  typename Controller::Parameters parameters{};
  parameters.friction_force = numeric::from_real<TypeParam>(0.5);
  parameters.speed_floor = numeric::from_real<TypeParam>(0.01);
  parameters.smallest_friction = control::FrictionLevel<TypeParam>::smallest();
  parameters.regulator = {numeric::from_real<TypeParam>(0.1), TypeParam{}, 3, 12, 1};
  parameters.stuck = {10};
  parameters.plausibility = {20};
  parameters.watch = {numeric::from_real<TypeParam>(0.01), 50, numeric::from_real<TypeParam>(0.8)};
  Controller controller(parameters);
  controller.set_target(numeric::from_real<TypeParam>(0.25));
  controller.start();

  constexpr std::int32_t force = 1 << 29;
  constexpr std::int32_t velocity = 1 << 28;
  ScriptedBoard board({{force, velocity, false, true},
                       {force + 1, velocity, false, true},
                       {force + 1, velocity, false, false},
                       {force + 2, velocity, false, true}});
  ControlLoop<Controller, ScriptedBoard> loop(controller, board);
  while (loop.serve()) {
  }
  ASSERT_EQ(board.driven.size(), 4U);
  // A ratio of a half takes r = sin(π/4): an amplitude of √2/8.
  EXPECT_NEAR(board.driven[1].amplitude, numeric::to_code(0.17677669529663689), 300.0);
  for (std::size_t i = 2; i < 4; ++i) {
    EXPECT_EQ(board.driven[i].amplitude, 0);
    EXPECT_EQ(board.driven[i].state, static_cast<std::uint8_t>(control::State::fault));
    EXPECT_EQ(board.driven[i].fault,
              static_cast<std::uint8_t>(control::Fault::measurement_missing));
  }
}

TEST(ExchangeTest, HandsOverTheMeanVelocityAndTheBias) {
  hal::MotionSample sample{};
  sample.fresh = true;
  sample.vibration_fresh = true;
  sample.quadrature = 1 << 28;
  sample.mean_velocity = -(1 << 30);
  const auto measurement = measurement_of<double>(sample);
  EXPECT_EQ(measurement.mean_velocity, -0.5);
  EXPECT_EQ(measurement.quadrature, 0.125);
  EXPECT_EQ(measurement.quality, control::Quality::good);
  EXPECT_EQ(measurement.vibration_quality, control::Quality::good);
  control::BiasedCommand<double> command{};
  command.amplitude = 0.25;
  command.bias = -0.5;
  const hal::BiasedDrive drive = drive_of(command);
  EXPECT_EQ(drive.amplitude, 1 << 29);
  EXPECT_EQ(drive.bias, -(1 << 30));
}

TEST(ExchangeTest, ASampleOfTheVibrationHasAQualityOfItsOwn) {
  hal::VibrationSample sample{};
  sample.fresh = true;
  sample.in_phase = -(1 << 29);
  const auto quality = [&](bool fresh, bool at_rail) {
    sample.vibration_fresh = fresh;
    sample.vibration_at_rail = at_rail;
    const auto measurement = measurement_of<float>(sample);
    EXPECT_EQ(measurement.in_phase, -0.25F);
    EXPECT_EQ(measurement.quality, control::Quality::good);
    return measurement.vibration_quality;
  };
  EXPECT_EQ(quality(true, false), control::Quality::good);
  EXPECT_EQ(quality(true, true), control::Quality::saturated);
  EXPECT_EQ(quality(false, true), control::Quality::missing);
}

TEST(ExchangeTest, HandsOverTheFrequency) {
  control::ResonantCommand<double> command{};
  command.amplitude = 0.25;
  command.frequency = -7;
  const hal::ResonantDrive drive = drive_of(command);
  EXPECT_EQ(drive.amplitude, 1 << 29);
  EXPECT_EQ(drive.frequency, -7);
}

}  // namespace
}  // namespace sonoglide::app::control_loop_test
