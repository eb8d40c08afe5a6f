// The board that is a plant: its sensor against the simulation's, its drive, and who watches it.
#include "firmware/image/plant/plant_board.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cstdint>

#include "firmware/image/plant/watched_board.hpp"
#include "firmware/numeric/float_format.hpp"
#include "firmware/plant/outcome.hpp"
#include "firmware/plant/state.hpp"
#include "host_sim/loop/control/sensor.hpp"
#include "tests/common/constants/pi.hpp"

namespace {

std::uint32_t counter = 0;

}  // namespace

extern "C" void start_counter() {
  counter = 0;
}
extern "C" std::uint32_t read_counter() {
  return counter;
}

namespace sonoglide::image::plant_board_test {
namespace {

struct AnyModel {};

/// A solver that says what it is told to, and remembers what it was asked.
struct ToldSolver {
  using Scalar = float;
  using Model = AnyModel;

  static inline float friction_integral = 0.0F;
  static inline plant::Error error = plant::Error::none;
  static inline plant::Interval<float> asked;

  void configure(const Model& /*model*/, float /*precision*/) {}

  template <class Account, class Observer>
  plant::Outcome<float> advance(const plant::Interval<float>& interval,
                                plant::State<float>& /*state*/, Account& account,
                                Observer& /*observer*/) {
    counter += 1000;
    asked = interval;
    account.friction_integral = friction_integral;
    return {error, 0.0F};
  }
};

class PlantBoardTest : public testing::Test {
 protected:
  PlantBoardTest() {
    ToldSolver::friction_integral = 0.0F;
    ToldSolver::error = plant::Error::none;
  }

  PlantBoard<ToldSolver, 0> board_{{{}, 1.0F, {}, 2.0F, 1.0F, 0.25F, 77}};
};

RC_GTEST_FIXTURE_PROP(PlantBoardTest, SamplesAsTheIdealSensorOfASimulationDoes, ()) {
  loop::Sensor sensor({}, {1.0, 1.0, 1.0, 1.0});
  const auto force = numeric::from_bits<float>(
      *rc::gen::resize(rc::kNominalSize, rc::gen::arbitrary<std::uint32_t>()));
  RC_PRE(numeric::is_finite(force));
  ToldSolver::friction_integral = force;
  const hal::Sample expected = sensor.sample(static_cast<double>(force), 0.0);
  hal::Sample sample{};
  RC_ASSERT(board_.sample(sample));
  RC_ASSERT(sample.friction_force == expected.friction_force);
  RC_ASSERT(sample.force_at_rail == expected.force_at_rail);
  RC_ASSERT(sample.sliding_velocity == 77);
  RC_ASSERT(sample.fresh);
}

TEST_F(PlantBoardTest, SamplesAsTheSimulationAboutTheRailsAndZero) {
  loop::Sensor sensor({}, {1.0, 1.0, 1.0, 1.0});
  for (const float force :
       {1.0F, 0x1.fffffep-1F, 0x1.000002p0F, -1.0F, -0x1.fffffep-1F, -0x1.000002p0F, 0.0F, -0.0F,
        0x1p-32F, -0x1p-32F, 0x1.8p-31F, -0x1.8p-31F, 0x1p-33F, 1e30F, -1e30F}) {
    ToldSolver::friction_integral = force;
    const hal::Sample expected = sensor.sample(static_cast<double>(force), 0.0);
    hal::Sample sample{};
    EXPECT_TRUE(board_.sample(sample));
    EXPECT_EQ(sample.friction_force, expected.friction_force) << force;
    EXPECT_EQ(sample.force_at_rail, expected.force_at_rail) << force;
  }
}

TEST_F(PlantBoardTest, NamesAVelocityAtTheEndOfItsRange) {
  for (const std::int32_t code : {INT32_MIN, INT32_MIN + 1, -1, 0, INT32_MAX - 1, INT32_MAX}) {
    PlantBoard<ToldSolver, 0> board({{}, 1.0F, {}, 2.0F, 1.0F, 0.25F, code});
    hal::Sample sample{};
    board.sample(sample);
    EXPECT_EQ(sample.velocity_at_rail, code == INT32_MIN || code == INT32_MAX) << code;
  }
}

TEST_F(PlantBoardTest, LivesThroughOnePeriodUnderTheLatestDrive) {
  hal::Sample sample{};
  board_.sample(sample);
  EXPECT_EQ(ToldSolver::asked.drive_amplitude, 0.0F);
  EXPECT_EQ(ToldSolver::asked.phase_begin, 0.0F);
  EXPECT_EQ(ToldSolver::asked.duration, static_cast<float>(tests::two_pi));
  EXPECT_EQ(ToldSolver::asked.sliding_velocity, 0.25F);
  EXPECT_EQ(ToldSolver::asked.sliding_acceleration, 0.0F);
  board_.drive({1 << 30, 0, 0, 0, 0, 0});
  board_.sample(sample);
  EXPECT_EQ(ToldSolver::asked.drive_amplitude, 1.0F);
}

TEST_F(PlantBoardTest, ShutsDownWhereTheSolverCannotGoOn) {
  ToldSolver::error = plant::Error::not_finite;
  hal::Sample sample{};
  EXPECT_FALSE(board_.sample(sample));
}

TEST_F(PlantBoardTest, IsWatchedWithoutADifference) {
  WatchedBoard watched(board_);
  hal::TraceHash samples;
  hal::TraceHash drives;
  for (std::int32_t i = 1; i <= 3; ++i) {
    hal::Sample sample{};
    ToldSolver::friction_integral = 0.25F * static_cast<float>(i);
    ASSERT_TRUE(watched.sample(sample));
    EXPECT_EQ(sample.friction_force, i << 29);
    counter += static_cast<std::uint32_t>(10 * i);  // the controller at work
    const hal::Drive drive{i << 28, i << 27, 1, 2, 3, 4};
    watched.drive(drive);
    samples.add(sample);
    drives.add(drive);
  }
  EXPECT_EQ(watched.periods(), 3U);
  EXPECT_EQ(watched.sample_hash(), samples.value());
  EXPECT_EQ(watched.trace_hash(), drives.value());
  EXPECT_EQ(watched.sampling().least(), 1000U);
  EXPECT_EQ(watched.sampling().sum(), 3000U);
  EXPECT_EQ(watched.answering().least(), 10U);
  EXPECT_EQ(watched.answering().most(), 30U);
  EXPECT_EQ(watched.answering().sum(), 60U);

  ToldSolver::error = plant::Error::not_finite;
  hal::Sample sample{};
  EXPECT_FALSE(watched.sample(sample));
  EXPECT_EQ(watched.sample_hash(), samples.value());
}

}  // namespace
}  // namespace sonoglide::image::plant_board_test
