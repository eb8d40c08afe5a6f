/// What an observer sees inside the steps, and that seeing changes nothing.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

#include "firmware/plant/gauss/event_gauss.hpp"
#include "tests/firmware/plant/runs/motion.hpp"

namespace sonoglide::plant::dense_output_test {
namespace {

struct Sample {
  double time;
  State<double> state;
};

/// Samples each step at its ends and inside it.
struct Recorder {
  std::vector<Sample> samples;
  double covered = 0.0;
  bool gapless = true;

  template <class Step>
  void operator()(const Step& step) {
    gapless = gapless && std::abs(step.begin() - covered) < 1e-13;
    covered = step.begin() + step.length();
    for (int i = 0; i <= 50; ++i) {
      const double offset = step.length() * i / 50.0;
      samples.push_back({step.begin() + offset, step.at(offset)});
    }
  }
};

using Dahl = DampedDahlModel<double>;
using Coulomb = DampedCoulombModel<double>;
using Panel = EventGauss<Dahl, 12>;

const Case strong = Case().contact_stiffness(8.0).friction_force(0.2).damping(0.1).stiffness(0.4);

template <class Solver>
class DenseOutput : public testing::Test {
 protected:
  using Contact = typename Solver::Model;
  static constexpr bool fixed_step = std::is_same_v<Solver, Rk4<Contact>>;
  static constexpr bool is_panel = std::is_same_v<Solver, Panel>;
  static constexpr double setting = fixed_step ? 1e-3 : is_panel ? 1e-10 : 1e-13;
  // Where a fixed step chatters about a stick, its state is known to a step only.
  static constexpr double tolerance = fixed_step ? 2e-3 : 1e-10;

  /// Weak where a panel is to serve it, and one that sticks where it can.
  static Solver solver() {
    const Case c =
        is_panel ? Case().contact_stiffness(0.4).friction_force(5e-5).damping(0.01).stiffness(0.05)
                 : strong.friction_force(Contact::FrictionLaw::sticks ? 0.4 : 0.2);
    return configured<Solver>(c, setting);
  }

  const Interval<double> interval = lasting(is_panel ? 2.0 * pi : 6.0)
                                        .from_phase(0.7)
                                        .driven(1.0)
                                        .sliding(0.3)
                                        .accelerating(0.02);
  const State<double> start = {0.1, 0.2, 0.05};
};

using Solvers =
    testing::Types<EventTaylor<Dahl, 12>, Rk4<Dahl>, Panel, EventTaylor<Coulomb, 12>, Rk4<Coulomb>>;
struct SolverName {
  template <class Solver>
  static std::string GetName(int /*index*/) {
    using Contact = typename Solver::Model;
    const std::string law = Contact::FrictionLaw::sticks ? "Coulomb" : "Dahl";
    return law + (std::is_same_v<Solver, Rk4<Contact>> ? "Rk4"
                  : std::is_same_v<Solver, Panel>      ? "Panel"
                                                       : "Taylor");
  }
};
TYPED_TEST_SUITE(DenseOutput, Solvers, SolverName);

TYPED_TEST(DenseOutput, AgreesWithAnAdvanceThatEndsThere) {
  auto solver = this->solver();
  Recorder recorder;
  NoAccount account;
  State<double> state = this->start;
  ASSERT_EQ(solver.advance(this->interval, state, account, recorder).error, Error::none);
  if (TestFixture::is_panel) {
    EXPECT_EQ(solver.cost().steps, 1U);
  }
  EXPECT_TRUE(recorder.gapless);
  EXPECT_NEAR(recorder.covered, this->interval.duration, 1e-12);
  const std::size_t stride = 1 + recorder.samples.size() / 200;
  for (std::size_t i = 0; i < recorder.samples.size(); i += stride) {
    const Sample& sample = recorder.samples[i];
    Interval<double> part = this->interval;
    part.duration = sample.time;
    const State<double> stopped = advanced(solver, part, this->start);
    EXPECT_NEAR(sample.state.displacement, stopped.displacement, this->tolerance);
    EXPECT_NEAR(sample.state.velocity, stopped.velocity, this->tolerance);
    if constexpr (!TypeParam::Model::FrictionLaw::sticks) {
      EXPECT_NEAR(sample.state.friction, stopped.friction, this->tolerance);
    }
    EXPECT_LE(std::abs(sample.state.friction), 1.0);
  }
}

TYPED_TEST(DenseOutput, ObservingChangesNoBit) {
  auto watched = this->solver();
  auto unwatched = this->solver();
  State<double> watched_state = this->start;
  State<double> unwatched_state = this->start;
  EnergyAccount<double> watched_account;
  EnergyAccount<double> unwatched_account;
  Recorder recorder;
  NoObserver none;
  watched.advance(this->interval, watched_state, watched_account, recorder);
  unwatched.advance(this->interval, unwatched_state, unwatched_account, none);
  EXPECT_EQ(watched_state.displacement, unwatched_state.displacement);
  EXPECT_EQ(watched_state.velocity, unwatched_state.velocity);
  EXPECT_EQ(watched_state.friction, unwatched_state.friction);
  EXPECT_EQ(watched_account.friction_integral, unwatched_account.friction_integral);
  EXPECT_EQ(watched_account.drive_work, unwatched_account.drive_work);
  EXPECT_EQ(watched.cost().steps, unwatched.cost().steps);
  EXPECT_EQ(watched.cost().events, unwatched.cost().events);
}

TYPED_TEST(DenseOutput, TheAccountChangesNoBit) {
  auto solver = this->solver();
  State<double> accounted = this->start;
  EnergyAccount<double> account;
  advance(solver, this->interval, accounted, account);
  const State<double> plain = advanced(solver, this->interval, this->start);
  EXPECT_EQ(accounted.displacement, plain.displacement);
  EXPECT_EQ(accounted.velocity, plain.velocity);
  EXPECT_EQ(accounted.friction, plain.friction);
}

TEST(DenseOutputOfFriction, FollowsTheExactArcInsideAStep) {
  auto solver = configured<EventTaylor<Dahl, 12>>(strong, 1e-13);
  Recorder recorder;
  NoAccount account;
  State<double> state = {0.0, 0.0, -0.9};
  ASSERT_EQ(solver.advance(lasting(5.0).driven(0.5).sliding(3.0), state, account, recorder).error,
            Error::none);
  for (const Sample& sample : recorder.samples) {
    const double travel = 3.0 * sample.time + sample.state.displacement;
    EXPECT_NEAR(sample.state.friction, 1.0 - 1.9 * std::exp(-8.0 * travel), 1e-13);
  }
}

}  // namespace
}  // namespace sonoglide::plant::dense_output_test
