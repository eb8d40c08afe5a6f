/// Each peer against values known to more than 20 digits, at Table 1.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <ostream>

#include "host_sim/studies/work_precision/peers/contender.hpp"
#include "tests/host_sim/studies/work_precision/peers/published/published_problems.hpp"
#ifdef SONOGLIDE_WITH_ODEINT
#endif
#ifdef SONOGLIDE_WITH_CVODE
#endif

namespace sonoglide::peers::peers_test {
namespace {

struct Peer {
  const char* name;
  std::unique_ptr<Contender> (*make)(const Problem& problem, double setting);
  double coarse;
  double fine;
  double coarse_error;  ///< relative, of the friction ratio
  double fine_error;
};

void PrintTo(const Peer& peer, std::ostream* stream) {
  *stream << peer.name;
}

double friction_ratio(const Contender& contender, int periods) {
  return contender.friction_integral() / (carrier_period * periods);
}

double error(const Contender& contender) {
  const auto exact = static_cast<double>(published_outcome("table1").friction_ratio);
  return std::abs(friction_ratio(contender, 100) / exact - 1.0);
}

class PeerTest : public testing::TestWithParam<Peer> {
 protected:
  std::unique_ptr<Contender> make(double setting) const {
    auto contender = GetParam().make(published_problem("table1"), setting);
    contender->restart();
    return contender;
  }
};

TEST_P(PeerTest, AgreesWithTheKnownFrictionRatio) {
  const auto coarse = make(GetParam().coarse);
  EXPECT_EQ(coarse->advance(100), "");
  EXPECT_LT(error(*coarse), GetParam().coarse_error);
  const auto fine = make(GetParam().fine);
  EXPECT_EQ(fine->advance(100), "");
  EXPECT_LT(error(*fine), GetParam().fine_error);
  EXPECT_GT(fine->steps(), coarse->steps());
}

TEST_P(PeerTest, HowTheRunIsCutChangesNothing) {
  const auto whole = make(GetParam().coarse);
  whole->advance(100);
  const auto cut = make(GetParam().coarse);
  for (int i = 0; i < 100; ++i) {
    cut->advance(1);
  }
  EXPECT_EQ(cut->friction_integral(), whole->friction_integral());
  EXPECT_EQ(cut->steps(), whole->steps());
}

TEST_P(PeerTest, ARestartForgetsEverything) {
  const auto contender = make(GetParam().coarse);
  contender->advance(100);
  const double first = contender->friction_integral();
  const std::uint64_t steps = contender->steps();
  contender->restart();
  EXPECT_EQ(contender->friction_integral(), 0.0);
  contender->advance(100);
  EXPECT_EQ(contender->friction_integral(), first);
  EXPECT_EQ(contender->steps(), steps);
}

TEST_P(PeerTest, StopsAtTheEndOfTheRun) {
  const auto contender = make(GetParam().coarse);
  contender->advance(100);
  // |phi| <= 1 bounds the integral by the length of the run.
  EXPECT_LE(contender->friction_integral(), 100.0 * carrier_period);
}

/// The errors are ten times and more those measured; a tolerance is of each step, not of the run.
const Peer peers[] = {
    {"rk4_table", rk4_table, 100, 3200, 1e-4, 5e-8},
    {"rk4_naive", rk4_naive, 100, 3200, 1e-4, 5e-8},
#ifdef SONOGLIDE_WITH_ODEINT
    {"odeint_dopri5", odeint_dopri5, 1e-6, 1e-10, 2e-3, 1e-7},
#endif
#ifdef SONOGLIDE_WITH_CVODE
    {"cvode_adams", cvode_adams, 1e-6, 1e-10, 2e-4, 1e-7},
    {"cvode_adams_fixed_point", cvode_adams_fixed_point, 1e-6, 1e-10, 2e-4, 1e-7},
    {"cvode_bdf", cvode_bdf, 1e-6, 1e-10, 2e-4, 1e-6},
#endif
};

INSTANTIATE_TEST_SUITE_P(All, PeerTest, testing::ValuesIn(peers),
                         [](const auto& peer) { return peer.param.name; });

TEST(PaperRk4Test, TheTableChangesNoResult) {
  const Problem problem = published_problem("table1_as_printed");
  const auto table = rk4_table(problem, 1000);
  const auto naive = rk4_naive(problem, 1000);
  table->restart();
  naive->restart();
  EXPECT_EQ(table->advance(100), "");
  EXPECT_EQ(naive->advance(100), "");
  EXPECT_EQ(table->friction_integral(), naive->friction_integral());
  EXPECT_EQ(table->steps(), 100000U);
}

TEST(PaperRk4Test, ThePapersStepIsTooLongForAStiffContact) {
  const auto contender = rk4_table(published_problem("stiff_contact"), 1000);
  contender->restart();
  EXPECT_EQ(contender->advance(100), "friction bound broken");
}

TEST(PaperRk4Test, DampingTakesItsPart) {
  // Steady motion of y'' = cos tau - d y' - k y: A cos tau + B sin tau. A contact too soft to
  // matter follows it, phi = kappa (y - y(0)), so the mean of phi is -kappa A.
  const double stiffness = 2.0;
  const double damping = 0.5;
  const double square = (stiffness - 1.0) * (stiffness - 1.0) + damping * damping;
  Problem problem{};
  problem.stiffness = stiffness;
  problem.damping = damping;
  problem.contact_stiffness = 1e-9;
  problem.vibration_sign = 1.0;
  problem.drive_amplitude = 1.0;
  problem.displacement = (stiffness - 1.0) / square;
  problem.velocity = damping / square;
  problem.periods = 10;
  const auto contender = rk4_table(problem, 1000);
  contender->restart();
  EXPECT_EQ(contender->advance(10), "");
  EXPECT_NEAR(friction_ratio(*contender, 10) / -1e-9, problem.displacement, 1e-7);
}

}  // namespace
}  // namespace sonoglide::peers::peers_test
