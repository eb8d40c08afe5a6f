#include "firmware/numeric/economised.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>

#include "firmware/numeric/power_series.hpp"

namespace sonoglide::numeric::economised_test {
namespace {

TEST(Economised, StaysWithinItsBound) {
  std::array<double, 25> series{};
  series[0] = 1.0;
  for (std::size_t n = 1; n < series.size(); ++n) {
    series[n] = series[n - 1] * 2.0 / static_cast<double>(n);  // exp(2 x)
  }
  std::array<double, 9> shortened{};
  const double bound = economise(series, shortened);
  double worst = 0.0;
  for (int i = -100; i <= 100; ++i) {
    const double x = i / 100.0;
    worst = std::fmax(worst, std::abs(evaluate(shortened, x) - std::exp(2.0 * x)));
  }
  EXPECT_LE(worst, bound + 1e-14);
  EXPECT_GE(worst, 0.1 * bound);
  EXPECT_LT(bound, 1e-5);  // the series cut there is wrong by 2e-3
}

}  // namespace
}  // namespace sonoglide::numeric::economised_test
