/// What a composition leaves out costs no byte: sizes exactly, above and below.

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "firmware/plant/rk4/rk4_event.hpp"
#include "firmware/plant/strang/equal_step_strang.hpp"
#include "tests/firmware/plant/runs/motion.hpp"

namespace sonoglide::plant::composition_size_test {
namespace {

template <class Scalar>
class CompositionSize : public testing::Test {
 protected:
  using Free = Model<friction::None<Scalar>, Undamped<Scalar>, NoDrive>;
  using FreeDamped = Model<friction::None<Scalar>, Damped<Scalar>, NoDrive>;
  using Driven = Model<friction::None<Scalar>, Undamped<Scalar>, CosineDrive>;
  using Coulomb = CoulombModel<Scalar>;
  using Dahl = DahlModel<Scalar>;
  using UndrivenDahl = Model<friction::Dahl<Scalar>, Undamped<Scalar>, NoDrive>;
  using DampedDahl = DampedDahlModel<Scalar>;

  static constexpr std::size_t number = sizeof(Scalar);
};
using Floats = testing::Types<double, float>;
TYPED_TEST_SUITE(CompositionSize, Floats);

TYPED_TEST(CompositionSize, WhatIsNotNamedIsEmpty) {
  EXPECT_TRUE(std::is_empty_v<friction::None<TypeParam>>);
  EXPECT_TRUE(std::is_empty_v<friction::Coulomb<TypeParam>>);
  EXPECT_TRUE(std::is_empty_v<Contact<friction::None<TypeParam>>>);
  EXPECT_TRUE(std::is_empty_v<Undamped<TypeParam>>);
  EXPECT_TRUE(std::is_empty_v<NoDrive>);
  EXPECT_TRUE(std::is_empty_v<NoDrive::Phasor<TypeParam>>);
  EXPECT_TRUE((std::is_empty_v<NoDrive::Series<TypeParam, 16>>));
  EXPECT_TRUE(std::is_empty_v<NoDrive::Samples<TypeParam>>);
  EXPECT_TRUE(std::is_empty_v<NoAccount>);
  EXPECT_TRUE(std::is_empty_v<NoObserver>);
}

TYPED_TEST(CompositionSize, AFreeOscillatorIsItsStiffness) {
  EXPECT_EQ(sizeof(typename TestFixture::Free), TestFixture::number);
}

TYPED_TEST(CompositionSize, EachPartAddsItsOwnParametersAndNoMore) {
  using Fixture = TestFixture;
  constexpr std::size_t free = sizeof(typename Fixture::Free);
  EXPECT_EQ(sizeof(typename Fixture::Driven), free);  // the amplitude comes with the interval
  EXPECT_EQ(sizeof(typename Fixture::FreeDamped), free + sizeof(Damped<TypeParam>));
  EXPECT_EQ(sizeof(typename Fixture::Coulomb),
            free + sizeof(Contact<friction::Coulomb<TypeParam>>));
  EXPECT_EQ(sizeof(typename Fixture::Dahl), free + sizeof(Contact<friction::Dahl<TypeParam>>));
  EXPECT_EQ(sizeof(typename Fixture::UndrivenDahl), sizeof(typename Fixture::Dahl));
  EXPECT_EQ(sizeof(typename Fixture::DampedDahl),
            sizeof(typename Fixture::Dahl) + sizeof(Damped<TypeParam>));
}

TYPED_TEST(CompositionSize, AContactIsItsThreeNumbers) {
  EXPECT_EQ(sizeof(Contact<friction::Dahl<TypeParam>>), 3 * TestFixture::number);
  EXPECT_EQ(sizeof(Damped<TypeParam>), TestFixture::number);
}

// Model, term and step allowed; the step limit; two totals.
TYPED_TEST(CompositionSize, ATaylorSolverIsItsModelAndItsSettings) {
  const auto rest = [](std::size_t model) {
    const std::size_t settings = model + 2 * sizeof(TypeParam) + sizeof(std::uint32_t);
    const std::size_t aligned = (settings + alignof(Cost) - 1) / alignof(Cost) * alignof(Cost);
    return aligned + sizeof(Cost);
  };
  using Fixture = TestFixture;
  EXPECT_EQ(sizeof(EventTaylor<typename Fixture::Free, 16>), rest(sizeof(typename Fixture::Free)));
  EXPECT_EQ(sizeof(EventTaylor<typename Fixture::Dahl, 16>), rest(sizeof(typename Fixture::Dahl)));
  EXPECT_EQ(sizeof(EventTaylor<typename Fixture::DampedDahl, 16>),
            rest(sizeof(typename Fixture::DampedDahl)));
  EXPECT_EQ(sizeof(Cost), 2 * sizeof(std::uint64_t));
}

TYPED_TEST(CompositionSize, OrderAddsNothing) {
  using Undriven = typename TestFixture::Free;
  EXPECT_EQ(sizeof(EventTaylor<Undriven, 20>), sizeof(EventTaylor<Undriven, 8>));
}

TYPED_TEST(CompositionSize, AFixedStepSolverIsItsModelAndItsStep) {
  const auto rest = [](std::size_t model) {
    const std::size_t settings = model + sizeof(TypeParam) + sizeof(std::uint32_t);
    const std::size_t aligned = (settings + alignof(Cost) - 1) / alignof(Cost) * alignof(Cost);
    return aligned + sizeof(Cost);
  };
  using Fixture = TestFixture;
  EXPECT_EQ(sizeof(Rk4<typename Fixture::Free>), rest(sizeof(typename Fixture::Free)));
  EXPECT_EQ(sizeof(Rk4<typename Fixture::DampedDahl>), rest(sizeof(typename Fixture::DampedDahl)));
  EXPECT_EQ(sizeof(Rk4Event<typename Fixture::Free>), sizeof(Rk4<typename Fixture::Free>));
  EXPECT_EQ(sizeof(Rk4Event<typename Fixture::DampedDahl>),
            sizeof(Rk4<typename Fixture::DampedDahl>));
}

TYPED_TEST(CompositionSize, ASeriesWithoutDriveHoldsNoCoefficientsOfIt) {
  using Fixture = TestFixture;
  using DrivenSeries = TaylorSeries<typename Fixture::Driven, 16>;
  using FreeSeries = TaylorSeries<typename Fixture::Free, 16>;
  EXPECT_EQ(sizeof(typename DrivenSeries::DriveSeries), 17 * Fixture::number);
  // An empty member takes the place of a byte.
  EXPECT_EQ(sizeof(DrivenSeries) - sizeof(FreeSeries), 16 * Fixture::number);
}

TYPED_TEST(CompositionSize, AnAccountIsTheIntegralsItIsNamedFor) {
  EXPECT_EQ(sizeof(MeanFriction<TypeParam>), TestFixture::number);
  EXPECT_EQ(sizeof(EnergyAccount<TypeParam>), 7 * TestFixture::number);
}

}  // namespace
}  // namespace sonoglide::plant::composition_size_test
