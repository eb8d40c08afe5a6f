/// What the panels of the Gauss method are built of: lanes, nodes, shortened series, reversals.

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "firmware/numeric/economised.hpp"
#include "firmware/numeric/gauss_nodes.hpp"
#include "firmware/plant/gauss/panel_motions.hpp"
#include "firmware/plant/gauss/panel_reversals.hpp"
#include "motion.hpp"

namespace sonoglide::plant {
namespace {

TEST(GaussNodes, IntegrateAPolynomialToEachNode) {
  constexpr auto& gauss = numeric::gauss_nodes<double, 8>;
  // f = x^7: its integral is x^8 / 8.
  const auto f = [&](std::size_t i) { return std::pow(gauss.node[i], 7); };
  for (std::size_t i = 0; i < 4; ++i) {
    double half_of_whole = 0.0;
    double alike = 0.0;
    double mirrored = 0.0;
    for (std::size_t j = 0; j < 4; ++j) {
      half_of_whole += 0.5 * gauss.weight[j] * (f(j) + f(4 + j));
      alike += gauss.of_differences[j][i] * (f(j) - f(4 + j));
      mirrored += gauss.of_sums[j][i] * (f(j) + f(4 + j));
    }
    EXPECT_NEAR(half_of_whole + alike + mirrored, std::pow(gauss.node[i], 8) / 8.0, 1e-15);
    EXPECT_NEAR(half_of_whole + alike - mirrored, std::pow(gauss.node[4 + i], 8) / 8.0, 1e-15);
  }
}

TEST(GaussNodes, KnowTheHighestLegendreCoefficients) {
  constexpr auto& gauss = numeric::gauss_nodes<double, 4>;
  // On [-1, 1]: P_3 = (5 x^3 - 3 x) / 2, P_2 = (3 x^2 - 1) / 2.
  double last = 0.0;
  double last_but_one = 0.0;
  const auto f = [&](std::size_t i) {
    const double x = 2.0 * gauss.node[i] - 1.0;
    return 1.25 * (5.0 * x * x * x - 3.0 * x) / 2.0 - 0.75 * (3.0 * x * x - 1.0) / 2.0 + x + 2.0;
  };
  for (std::size_t j = 0; j < 2; ++j) {
    last += gauss.last_of_differences[j] * (f(j) - f(2 + j));
    last_but_one += gauss.last_but_one_of_sums[j] * (f(j) + f(2 + j));
  }
  EXPECT_NEAR(last, 1.25, 1e-14);
  EXPECT_NEAR(last_but_one, -0.75, 1e-14);
}

TEST(Economised, StaysWithinItsBound) {
  std::array<double, 25> series{};
  series[0] = 1.0;
  for (std::size_t n = 1; n < series.size(); ++n) {
    series[n] = series[n - 1] * 2.0 / static_cast<double>(n);  // exp(2 x)
  }
  std::array<double, 9> shortened{};
  const double bound = numeric::economise(series, shortened);
  double worst = 0.0;
  for (int i = -100; i <= 100; ++i) {
    const double x = i / 100.0;
    worst = std::fmax(worst, std::abs(numeric::evaluate(shortened, x) - std::exp(2.0 * x)));
  }
  EXPECT_LE(worst, bound + 1e-14);
  EXPECT_GE(worst, 0.1 * bound);
  EXPECT_LT(bound, 1e-5);  // the series cut there is wrong by 2e-3
}

TEST(PanelMotions, AreThoseOfTheOscillator) {
  using Damped = DampedDahlModel<double>;
  const Damped model = {{{1.0}, 0.0, 1.0}, {0.3}, 0.7};
  using Motions = PanelMotions<Damped, 19, 9>;
  const Motions motions(model, pi);
  auto taylor = configured<EventTaylor<Damped, 16>>(model, 1e-15);
  // A panel from x = -1 under cos(tau): what is left of the two free motions at its end.
  const State<double> before = {0.4, -0.3, 0.0};
  const State<double> end = advanced(taylor, {0.0, 2.0 * pi, 1.0, 0.0, 0.0}, before);
  const auto& begin = motions.begin;
  const double y = before.displacement + begin[2].value;  // cos(tau) = -cos(pi x)
  const double rate = pi * before.velocity + begin[2].rate;
  const double c =
      motions.unwound(y * begin[1].rate - rate * begin[1].value, begin[0].value, begin[1].value);
  const double s =
      motions.unwound(rate * begin[0].value - y * begin[0].rate, begin[0].value, begin[1].value);
  EXPECT_NEAR(c * motions.end[0].value + s * motions.end[1].value - motions.end[2].value,
              end.displacement, 1e-12);
  EXPECT_NEAR(c * motions.end[0].rate + s * motions.end[1].rate - motions.end[2].rate,
              pi * end.velocity, 1e-12);
}

/// V = level + cos(pi x) on the grid.
PanelReversals<double> reversals_of(double level, bool& certain) {
  GridVelocity<double> grid{};
  for (std::size_t g = 0; g < PanelGrid::points; ++g) {
    const double x = static_cast<double>(g) / 8.0 - 1.0;
    grid.velocity[g / 2][g % 2] = level + std::cos(pi * x);
  }
  const auto slope = [](std::size_t g) {
    return -pi * std::sin(pi * (static_cast<double>(g) / 8.0 - 1.0));
  };
  const double hidden = PanelGrid::hidden<double>;
  PanelReversals<double> found;
  certain = grid.find(hidden * pi * pi, hidden * pi * pi * pi, slope, found);
  return found;
}

TEST(GridVelocity, FindsReversals) {
  for (const double level : {-0.9, -0.5, 0.1, 0.77, 0.9}) {
    bool certain = false;
    const PanelReversals<double> found = reversals_of(level, certain);
    EXPECT_TRUE(certain);
    EXPECT_EQ(found.direction, -1.0);
    ASSERT_EQ(found.count, 2U);
    EXPECT_NEAR(found.at[0], -std::acos(-level) / pi, 1e-4);
    EXPECT_NEAR(found.at[1], std::acos(-level) / pi, 1e-4);
  }
}

TEST(GridVelocity, FindsNoneWhereThereIsNone) {
  bool certain = false;
  EXPECT_EQ(reversals_of(1.1, certain).count, 0U);
  EXPECT_TRUE(certain);
  EXPECT_EQ(reversals_of(-1.1, certain).count, 0U);
  EXPECT_TRUE(certain);
}

TEST(GridVelocity, SaysWhereItCannotTell) {
  for (const double level : {1.0, 1.01, -1.01, -1.0, 0.999}) {
    bool certain = true;
    reversals_of(level, certain);
    EXPECT_FALSE(certain) << level;
  }
}

}  // namespace
}  // namespace sonoglide::plant
