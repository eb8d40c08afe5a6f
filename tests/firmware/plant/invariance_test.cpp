/// What the motion and its friction do not depend on: where a free mass stands, and the unit of
/// length.

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <type_traits>

#include "firmware/plant/gauss/event_gauss.hpp"
#include "tests/firmware/plant/runs/motion.hpp"

namespace sonoglide::plant::invariance_test {
namespace {

constexpr int periods = 3;

double any_between(double low, double high) {
  constexpr int steps = 1000000;
  const int step = *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, steps + 1));
  return low + (high - low) * step / steps;
}

/// A plant, its sliding velocity, and its state; the drive's amplitude is 1.
struct Scene {
  double contact_stiffness;
  double friction_force;
  double damping;
  double stiffness;
  double sliding_velocity;
  double velocity;
};

Scene any_scene() {
  return {std::pow(10.0, any_between(-2.0, 2.0)),
          std::pow(10.0, any_between(-5.0, -0.5)),
          any_between(0.0, 1.0),
          any_between(0.0, 5.0),
          any_between(-1.2, 1.2),
          any_between(-1.0, 1.0)};
}

template <class Model>
Model model_of(const Scene& scene, double unit) {
  using Scalar = typename Model::Scalar;
  const auto scalar = [](double x) { return static_cast<Scalar>(x); };
  typename Model::FrictionLaw law{};
  if constexpr (Model::FrictionLaw::varies) {
    law.contact_stiffness = scalar(scene.contact_stiffness * unit);
  }
  return {{law, scalar(scene.friction_force / unit), Scalar(1)},
          {scalar(scene.damping)},
          scalar(scene.stiffness)};
}

/// The mean friction, and the state at the end in units of the scene's own.
template <class Solver>
struct Run {
  using Model = typename Solver::Model;
  using Scalar = typename Solver::Scalar;

  State<Scalar> state;
  MeanFriction<Scalar> friction;
  Error error;

  /// unit: of length, over the scene's own.
  Run(const Scene& scene, double displacement, double unit, double tolerance)
      : state{static_cast<Scalar>(displacement / unit), static_cast<Scalar>(scene.velocity / unit),
              Scalar(0)} {
    auto solver = configured<Solver>(model_of<Model>(scene, unit), static_cast<Scalar>(tolerance));
    error = run_periods(solver, periods, static_cast<Scalar>(1.0 / unit),
                        static_cast<Scalar>(scene.sliding_velocity / unit), state, friction);
    state.velocity *= static_cast<Scalar>(unit);
  }
  double friction_ratio() const {
    return static_cast<double>(friction.friction_integral) / (2.0 * pi * periods);
  }
};

template <class Solver>
class Invariance : public testing::Test {
 public:
  static constexpr bool is_single = std::is_same_v<typename Solver::Scalar, float>;
  static constexpr double tolerance = is_single ? 1e-6 : 1e-10;
  /// The stiffest of these contacts magnify an error of the velocity a hundred times and more.
  static constexpr double allowed = 1000.0 * tolerance;
};

using Solvers = testing::Types<
    EventTaylor<DampedDahlModel<double>, 8>, EventTaylor<DampedDahlModel<double>, 12>,
    EventTaylor<DampedDahlModel<double>, 16>, EventTaylor<DampedDahlModel<float>, 8>,
    EventTaylor<DampedCoulombModel<double>, 16>, EventTaylor<DampedCoulombModel<float>, 8>,
    EventGauss<DampedDahlModel<double>, 12>, EventGauss<DampedDahlModel<float>, 8>>;
struct SolverName {
  template <class Solver>
  static std::string GetName(int index) {
    return std::to_string(index) + (Invariance<Solver>::is_single ? "Single" : "Double");
  }
};
TYPED_TEST_SUITE(Invariance, Solvers, SolverName);

/// To the bit where its displacement does not enter; EventGauss leaves to Taylor's method what it
/// cannot tell from the displacement.
TYPED_TEST(Invariance, AFreeMassMovesAlikeWhereverItStands) {
  constexpr bool is_taylor = !std::is_same_v<TypeParam, EventGauss<DampedDahlModel<double>, 12>> &&
                             !std::is_same_v<TypeParam, EventGauss<DampedDahlModel<float>, 8>>;
  EXPECT_TRUE(rc::check([] {
    Scene scene = any_scene();
    scene.stiffness = 0.0;
    const double distance = std::pow(10.0, any_between(0.0, 18.0));
    const Run<TypeParam> here(scene, 0.0, 1.0, TestFixture::tolerance);
    const Run<TypeParam> there(scene, distance, 1.0, TestFixture::tolerance);
    RC_ASSERT(here.error == Error::none && there.error == Error::none);
    constexpr double limit = is_taylor ? 0.0 : TestFixture::allowed;
    RC_ASSERT(std::abs(here.friction_ratio() - there.friction_ratio()) <= limit);
    RC_ASSERT(std::abs(here.state.velocity - there.state.velocity) <= limit);
    RC_ASSERT(std::abs(here.state.friction - there.state.friction) <= limit);
  }));
}

/// However small the motion is in the units of the plant.
TYPED_TEST(Invariance, TheUnitOfLengthIsFree) {
  EXPECT_TRUE(rc::check([] {
    const Scene scene = any_scene();
    const double unit = std::exp2(any_between(0.0, TestFixture::is_single ? 60.0 : 400.0));
    const Run<TypeParam> usual(scene, 0.0, 1.0, TestFixture::tolerance);
    const Run<TypeParam> small(scene, 0.0, unit, TestFixture::tolerance);
    RC_ASSERT(usual.error == Error::none && small.error == Error::none);
    RC_ASSERT(std::abs(usual.friction_ratio() - small.friction_ratio()) <= TestFixture::allowed);
    RC_ASSERT(std::abs(usual.state.velocity - small.state.velocity) <= TestFixture::allowed);
    RC_ASSERT(std::abs(usual.state.friction - small.state.friction) <= TestFixture::allowed);
  }));
}

template <class Number, std::size_t Order>
struct Precise {
  using Scalar = Number;
  static constexpr std::size_t order = Order;
};

template <class Precision>
class StuckContact : public testing::Test {};

using Precisions = testing::Types<Precise<double, 8>, Precise<double, 12>, Precise<double, 16>,
                                  Precise<float, 8>, Precise<float, 12>>;
struct PrecisionName {
  template <class Precision>
  static std::string GetName(int /*index*/) {
    return "Taylor" + std::to_string(Precision::order) +
           (std::is_same_v<typename Precision::Scalar, float> ? "Single" : "Double");
  }
};
TYPED_TEST_SUITE(StuckContact, Precisions, PrecisionName);

/// Far below its friction limit a Dahl contact is a spring of stiffness beta kappa: from rest a
/// free mass on it moves by a (cos tau - cos(w tau)) / (w^2 - 1), w^2 = beta kappa, phi = kappa
/// times that. The mass stands far from where displacement is counted from.
TYPED_TEST(StuckContact, IsASpringHoweverSlowItsVibration) {
  using Scalar = typename TypeParam::Scalar;
  using Contact = DahlModel<Scalar>;
  constexpr bool is_single = std::is_same_v<Scalar, float>;
  constexpr double largest_friction = is_single ? 1e-6 : 1e-10;
  constexpr double accuracy = is_single ? 1e-3 : 1e-7;
  constexpr double square = 50.0;
  const double rate = std::sqrt(square);
  for (const double amplitude : {1e-3, 1e-9, 1e-12, 1e-15, 1e-18, 1e-22}) {
    const double travel = 2.0 * amplitude / (square - 1.0);
    const double stiffness = largest_friction / travel;
    const Contact model = Case().contact_stiffness(stiffness).friction_force(square / stiffness);
    auto solver = configured<EventTaylor<Contact, TypeParam::order>>(
        model, static_cast<Scalar>(is_single ? 1e-6 : 1e-10));
    const double duration = 11.0;
    State<Scalar> state{Scalar(1), Scalar(0), Scalar(0)};
    state = advanced(solver, lasting(duration).driven(amplitude), state);
    const double velocity =
        amplitude / (square - 1.0) * (rate * std::sin(rate * duration) - std::sin(duration));
    const double displacement =
        amplitude / (square - 1.0) * (std::cos(duration) - std::cos(rate * duration));
    EXPECT_NEAR(static_cast<double>(state.velocity), velocity, accuracy * rate * travel)
        << amplitude;
    EXPECT_NEAR(static_cast<double>(state.friction), stiffness * displacement,
                accuracy * largest_friction)
        << amplitude;
  }
}

}  // namespace
}  // namespace sonoglide::plant::invariance_test
