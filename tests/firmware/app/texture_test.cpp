// A target along the sliding distance: the path against sums in 128 bits, the targets against the straight
// lines that they stand for.
#include "firmware/app/texture.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "firmware/app/target_schedule.hpp"
#include "firmware/numeric/fixed.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::app::texture_test {
namespace {

__extension__ using Wide = __int128;
using Q31 = numeric::Q31<numeric::Saturating>;
using Q15 = numeric::Q15<numeric::Saturating>;

/// As a design makes them: a step at full speed is `advance` periods of the path.
struct Path {
  TexturePath::Parameters parameters;
  std::uint32_t weight;
};
Path path_of(double advance, double lead_steps = 0.0) {
  const int exponent = 28 + static_cast<int>(std::floor(std::log2(advance)));
  const double period = std::ldexp(1.0 / advance, 31 + exponent);
  return {{std::llround(period),
           static_cast<std::uint32_t>(
               std::min(std::ldexp(1.0 / period, 90) * (1.0 - 0x1p-50), 4294967295.0)),
           static_cast<std::uint32_t>(std::llround(std::ldexp(advance * lead_steps, 27)))},
          std::uint32_t{1} << exponent};
}

Wide modulo(Wide a, Wide b) {
  const Wide rest = a % b;
  return rest < 0 ? rest + b : rest;
}

/// Random walks at random speeds: the place is the exact sum of all steps, modulo the period.
RC_GTEST_PROP(TexturePath, IsTheSumOfAllStepsModuloThePeriod, ()) {
  const Path path = path_of(std::exp2(-*rc::gen::inRange(-3000, 27'000) / 1000.0));
  RC_ASSERT(path.parameters.period > std::int64_t{1} << 58);
  RC_ASSERT(path.parameters.period <= std::int64_t{1} << 59);
  TexturePath walked(path.parameters);
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  Wide sum = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto velocity = static_cast<std::int32_t>(random());
    // Steps up to 6.4 % longer, and shorter.
    const auto weight =
        static_cast<std::uint32_t>(std::uint64_t{path.weight} * (940 + random() % 124) / 1000);
    walked.advance(velocity, weight);
    sum += Wide{velocity} * Wide{weight};
    RC_ASSERT(walked.distance() == static_cast<std::int64_t>(modulo(sum, path.parameters.period)));
  }
}

/// A kilometre of a texture of 0.125 mm at 0.9 m/s under steps of 33 kHz, against the rational distance.
TEST(TexturePath, HasNoDriftOverAKilometre) {
  constexpr double full_m_per_s = 0.96;
  constexpr double step_s = 1.0 / 33e3;
  constexpr double period_m = 0.125e-3;
  const Path path = path_of(full_m_per_s * step_s / period_m);
  TexturePath walked(path.parameters);
  const auto velocity = static_cast<std::int32_t>(std::lround(0.9 / full_m_per_s * 0x1p31));
  const double step_m = velocity * 0x1p-31 * full_m_per_s * step_s;
  const auto steps = static_cast<std::int64_t>(1000.0 / step_m);
  for (std::int64_t i = 0; i < steps; ++i) {
    walked.advance(velocity, path.weight);
  }
  // In units of 2^-80 periods: a step is known to 2^-64 of itself, and so is the sum of them all.
  const long double periods_of_step = static_cast<long double>(full_m_per_s) *
                                      static_cast<long double>(step_s) /
                                      static_cast<long double>(period_m);
  const auto step =
      static_cast<Wide>(std::ldexp(static_cast<long double>(velocity) * periods_of_step, 80 - 31));
  const Wide place = modulo(Wide{steps} * step, Wide{1} << 80);
  const double expected = static_cast<double>(place) * 0x1p-80;
  const double found = walked.turn() * 0x1p-32;
  EXPECT_NEAR(std::remainder(found - expected, 1.0), 0.0, 1e-8);
}

RC_GTEST_PROP(TexturePath, TellsItsPlaceInTurns, ()) {
  const Path path = path_of(std::exp2(-*rc::gen::inRange(-3000, 27'000) / 1000.0));
  TexturePath walked(path.parameters);
  const auto place = static_cast<std::int64_t>(*rc::gen::arbitrary<std::uint64_t>() %
                                               static_cast<std::uint64_t>(path.parameters.period));
  walked.set_distance(place);
  const long double exact = static_cast<long double>(place) / path.parameters.period * 0x1p32L;
  const long double error = walked.turn() - exact;
  RC_ASSERT(error <= 0.0L);
  RC_ASSERT(error > -4.0L);
}

TEST(TexturePath, LooksAheadByTheVelocity) {
  constexpr double advance = 0.02;
  constexpr double lead = 3.75;
  const Path path = path_of(advance, lead);
  TexturePath walked(path.parameters);
  for (const double speed : {0.5, 0.01, -0.5}) {
    const auto velocity = static_cast<std::int32_t>(speed * 0x1p31);
    walked.advance(velocity, path.weight);
    const double ahead =
        std::remainder((walked.turn_ahead(velocity) * 0x1p-32) - (walked.turn() * 0x1p-32), 1.0);
    EXPECT_NEAR(ahead, speed * advance * lead, 1e-8);
  }
}

TEST(WordedSteps, AreAsLongAsTheWordOfTheStartOverTheirOwn) {
  struct Frequency {
    std::int32_t steps;
    std::int32_t next_frequency() const { return steps; }
  };
  for (const std::uint32_t start : {555U, 1'515'000U, 1U << 28, 0x7fffffffU}) {
    const WordedSteps steps{1U << 29, start};
    for (const double deviation : {-0.06, -1e-3, 0.0, 1e-3, 0.06}) {
      const Frequency frequency{static_cast<std::int32_t>(deviation * start)};
      const double exact = 0x1p29 * start / (static_cast<double>(start) + frequency.steps);
      std::uint32_t rest = 0;
      double sum = 0.0;
      for (int i = 1; i <= 1000; ++i) {
        const double weight = steps.weight_of(frequency, rest);
        EXPECT_NEAR(weight, exact, 1.0);
        sum += weight;
        ASSERT_NEAR(sum, i * exact, 1.0 + 1e-3);  // nothing is lost
      }
    }
  }
}

struct Period {
  static constexpr double period_m = 1e-3;
};

/// A board that counts no distance.
struct Nobody {
} nobody;

struct Told {
  std::vector<double> targets;
  template <class Scalar>
  void set_target(Scalar target) {
    targets.push_back(numeric::to_real(target));
  }
};

template <class Scalar>
class TextureOf : public testing::Test {};
using Scalars = testing::Types<double, float, Q31, Q15>;
TYPED_TEST_SUITE(TextureOf, Scalars);

/// The targets of a run are those of the distance at which each acts: exact in the position, and in
/// every scalar the same place.
TYPED_TEST(TextureOf, FollowsTheStraightLinesBetweenItsPoints) {
  using Scalar = TypeParam;
  constexpr double advance = 0.03;
  constexpr double lead = 4.5;
  const Path path = path_of(advance, lead);
  const std::vector<double> values{0.2, 0.35, 0.25, 0.1, 0.15};
  std::vector<Scalar> points;
  for (const double value : values) {
    points.push_back(numeric::from_real<Scalar>(value));
  }
  const TextureTargets<Scalar, EqualSteps, Period> targets{
      {path.weight}, path.parameters, points.data(), static_cast<std::uint16_t>(points.size())};
  auto schedule = schedule_of(targets);
  Told controller;
  std::mt19937_64 random(1);
  std::vector<double> expected;
  double distance = 0.0;
  double speed = 0.0;
  for (int i = 0; i < 5000; ++i) {
    distance += advance * speed;
    const double turns = distance + advance * lead * speed;
    const double place = (turns - std::floor(turns)) * static_cast<double>(values.size());
    const auto before = static_cast<std::size_t>(place);
    const double after = values[(before + 1) % values.size()];
    expected.push_back(values[before] + (place - std::floor(place)) * (after - values[before]));
    schedule.advance(controller);
    hal::Sample sample{};
    sample.fresh = i % 10 != 3;  // one that is missing says nothing
    sample.sliding_velocity = static_cast<std::int32_t>(random());
    schedule.pass(sample, nobody);
    speed = sample.fresh ? sample.sliding_velocity * 0x1p-31 : speed;
  }
  const double rounding = sizeof(Scalar) == 2 ? 1e-4 : 1e-7;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ASSERT_NEAR(controller.targets[i], expected[i], rounding) << i;
  }
}

/// A board whose encoder has 1 um to a count, and whose count wraps on the way.
struct Encoder {
  static constexpr double travel_counts_per_m = 1e6;
  std::int64_t counted = 0;
  std::uint32_t travel() const { return static_cast<std::uint32_t>(counted); }
};
static_assert(hal::counts_travel<Encoder> && !hal::counts_travel<Nobody> &&
              !hal::counts_travel<void>);

/// Any count at all, forward and backward: the place is the exact sum modulo the period.
RC_GTEST_PROP(CountedPath, IsTheSumOfAllCountsModuloThePeriod, ()) {
  const double counts = std::exp2(*rc::gen::inRange(3000, 30'000) / 1000.0);
  const CountedPath path = counted_path(counts);
  RC_ASSERT(path.path.period > std::int64_t{1} << 58);
  RC_ASSERT(path.path.period <= std::int64_t{1} << 59);
  RC_ASSERT(path.path.period ==
            static_cast<std::int64_t>(counts * static_cast<double>(path.encoder.count)));
  RC_ASSERT(path.path.inverse ==
            static_cast<std::uint32_t>((Wide{1} << 90) / Wide{path.path.period}));
  TexturePath walked(path.path);
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  Wide sum = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto counted =
        static_cast<std::int32_t>(static_cast<std::int64_t>(random()) >> (32 + random() % 32));
    walked.advance_counted(counted, path.encoder);
    sum += Wide{counted} * Wide{path.encoder.count};
    RC_ASSERT(walked.distance() == static_cast<std::int64_t>(modulo(sum, path.path.period)));
  }
}

struct ShortPeriod {
  static constexpr double period_m = 0.125e-3;
};
/// 123 4567 / 10 000 counts.
struct OddPeriod {
  static constexpr double period_m = 0.1234567e-3;
};

template <class Scalar, class Period>
TextureTargets<Scalar, EqualSteps, Period> sawtooth(const std::vector<Scalar>& points,
                                                    const Path& path) {
  return {{path.weight}, path.parameters, points.data(), static_cast<std::uint16_t>(points.size())};
}

/// A kilometre in steps of up to 20 mm, one in a hundred of them back: a thousand million counts. The targets
/// are those of the rational distance.
template <class Scalar, class Period>
void expect_exact_over_a_kilometre(std::int64_t period_counts, std::int64_t over) {
  const Path path = path_of(0.01);
  const std::vector<double> values{0.1, 0.2, 0.4, 0.3};
  std::vector<Scalar> points;
  for (const double value : values) {
    points.push_back(numeric::from_real<Scalar>(value));
  }
  const auto targets = sawtooth<Scalar, Period>(points, path);
  auto schedule = schedule_of<Encoder>(targets);
  Encoder encoder;
  Told controller;
  std::mt19937_64 random(1);
  hal::Sample sample{};
  sample.fresh = true;
  while (encoder.counted < 1'000'000'000) {
    const auto step = static_cast<std::int64_t>(random() % 20'000);
    encoder.counted += step % 100 == 0 ? -step : step;
    schedule.pass(sample, encoder);
    schedule.advance(controller);
  }
  const Wide place = modulo(Wide{encoder.counted} * over, period_counts);
  const double turns = static_cast<double>(place) / static_cast<double>(period_counts);
  const double corner = turns * static_cast<double>(values.size());
  const auto before = static_cast<std::size_t>(corner);
  const double expected =
      values[before] +
      (corner - std::floor(corner)) * (values[(before + 1) % values.size()] - values[before]);
  EXPECT_NEAR(controller.targets.back(), expected, sizeof(Scalar) == 2 ? 1e-4 : 1e-7);
}

TYPED_TEST(TextureOf, IsExactOverAKilometreThatTheBoardCounts) {
  expect_exact_over_a_kilometre<TypeParam, ShortPeriod>(125, 1);
  expect_exact_over_a_kilometre<TypeParam, OddPeriod>(1'234'567, 10'000);
}

/// Whatever the velocity says; it leads, as ever. What is missing is its sample, not its distance.
TYPED_TEST(TextureOf, LiesAlongTheCountOfTheBoard) {
  using Scalar = TypeParam;
  constexpr double advance = 0.03;
  constexpr double lead = 4.5;
  const Path path = path_of(advance, lead);
  const std::vector<Scalar> points{numeric::from_real<Scalar>(0.1),
                                   numeric::from_real<Scalar>(0.3)};
  const auto targets = sawtooth<Scalar, Period>(points, path);
  auto schedule = schedule_of<Encoder>(targets);
  Encoder encoder;
  encoder.counted = std::int64_t{0xffffff00} - (std::int64_t{1} << 32);  // just before 0
  Told controller;
  std::mt19937_64 random(1);
  double speed = 0.0;
  for (int i = 0; i < 5000; ++i) {
    encoder.counted += static_cast<std::int64_t>(random() % 100) - 20;
    hal::Sample sample{};
    sample.fresh = i % 10 != 3;
    sample.sliding_velocity = static_cast<std::int32_t>(random()) / 4;
    schedule.pass(sample, encoder);
    speed = sample.fresh ? sample.sliding_velocity * 0x1p-31 : speed;
    schedule.advance(controller);
    const double turns = static_cast<double>(encoder.counted) * 1e-3 + advance * lead * speed;
    const double up = 2.0 * (turns - std::floor(turns));
    ASSERT_NEAR(controller.targets.back(), 0.1 + 0.2 * (up < 1.0 ? up : 2.0 - up),
                sizeof(Scalar) == 2 ? 1e-4 : 1e-7)
        << i;
  }
}

TYPED_TEST(TextureOf, GoesOnFromItsState) {
  using Scalar = TypeParam;
  const Path path = path_of(0.1, 3.0);
  const Scalar points[] = {numeric::from_real<Scalar>(0.1), numeric::from_real<Scalar>(0.4)};
  const TextureTargets<Scalar, EqualSteps, Period> targets{
      {path.weight}, path.parameters, points, 2};
  auto first = schedule_of(targets);
  auto second = schedule_of(targets);
  Told told;
  Told again;
  hal::Sample sample{};
  sample.fresh = true;
  sample.sliding_velocity = 1 << 29;
  for (int i = 0; i < 100; ++i) {
    first.advance(told);
    first.pass(sample, nobody);
  }
  second.set_state(first.state());
  for (int i = 0; i < 100; ++i) {
    first.advance(told);
    second.advance(again);
    first.pass(sample, nobody);
    second.pass(sample, nobody);
  }
  EXPECT_TRUE(std::equal(again.targets.begin(), again.targets.end(), told.targets.begin() + 100));
}

/// An order of 0 is to follow it; the place moves under other targets all the same.
TEST(TextureCourse, IsFollowedUnlessAnotherTargetIsOrdered) {
  const Path path = path_of(0.25);
  const float points[] = {0.1F, 0.3F};
  const TextureTargets<float, EqualSteps, Period> targets{
      {path.weight}, path.parameters, points, 2};
  auto course = course_of<void>(targets);
  EXPECT_EQ(first_target(targets), 0.0F);
  Told told;
  hal::Sample sample{};
  sample.fresh = true;
  sample.sliding_velocity = INT32_MAX;
  const auto step = [&] {
    course.move(told);
    course.aim(told);
    course.pass(sample, nobody);
    return told.targets.size();
  };
  EXPECT_EQ(step(), 1U);
  EXPECT_FALSE(course.takes(0.2F));
  EXPECT_EQ(step(), 1U);
  EXPECT_TRUE(course.takes(0.0F));
  EXPECT_EQ(step(), 2U);
  EXPECT_NEAR(told.targets.front(), 0.1, 1e-6);
  EXPECT_NEAR(told.targets.back(), 0.3, 1e-6);  // two quarters on
}

}  // namespace
}  // namespace sonoglide::app::texture_test
