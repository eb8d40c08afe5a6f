/// The first root of polynomials whose roots are known.

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "firmware/plant/first_root.hpp"

namespace sonoglide::plant {
namespace {

/// Positive at 0, with these roots and no others.
template <std::size_t Roots>
std::array<double, Roots + 1> with_roots(const std::array<double, Roots>& roots) {
  std::array<double, Roots + 1> p{1.0};
  std::size_t degree = 0;
  for (const double root : roots) {
    ++degree;
    for (std::size_t n = degree; n > 0; --n) {
      p[n] = p[n] - p[n - 1] / root;
    }
  }
  return p;
}

TEST(FirstRoot, Simple) {
  EXPECT_NEAR(first_root(with_roots<3>({0.25, 2.0, -3.0}), 1.0), 0.25, 1e-15);
  EXPECT_NEAR(first_root(with_roots<5>({0.9, 0.3, 0.6, -1.0, 4.0}), 1.0), 0.3, 1e-14);
}

TEST(FirstRoot, NoneIsTheEnd) {
  EXPECT_EQ(first_root(with_roots<3>({1.1, 2.0, 3.0}), 1.0), 1.0);
  EXPECT_EQ(first_root(with_roots<3>({-0.1, -0.2, -0.3}), 1.0), 1.0);
  EXPECT_EQ(first_root(std::array<double, 4>{1.0, 0.0, 0.0, 0.0}, 1.0), 1.0);
  EXPECT_EQ(first_root(std::array<double, 4>{0.01, -0.1, 1.0, 0.0}, 1.0), 1.0);
}

TEST(FirstRoot, OfANarrowPair) {
  for (const double gap : {1e-1, 1e-3, 1e-5, 1e-7}) {
    EXPECT_NEAR(first_root(with_roots<4>({0.5, 0.5 + gap, 5.0, -7.0}), 1.0), 0.5, 1e-7) << gap;
  }
}

TEST(FirstRoot, OfADoubleRoot) {
  EXPECT_NEAR(first_root(with_roots<4>({0.5, 0.5, 5.0, -7.0}), 1.0), 0.5, 1e-7);
}

TEST(FirstRoot, DoesNotDependOnTheSizeOfThePolynomial) {
  for (const double size : {1e-300, 1e-200, 1e-100, 1e100, 1e200, 1e300}) {
    auto p = with_roots<4>({0.5, 0.8, 5.0, -7.0});
    for (double& coefficient : p) {
      coefficient *= size;
    }
    EXPECT_NEAR(first_root(p, 1.0), 0.5, 1e-14) << size;
  }
}

TEST(FirstRoot, CloseToTheBeginning) {
  EXPECT_NEAR(first_root(with_roots<3>({1e-12, 0.5, 2.0}), 1.0) / 1e-12, 1.0, 1e-3);
}

long double value_at(const std::array<double, 9>& p, long double t) {
  long double value = 0.0L;
  for (std::size_t n = p.size(); n-- > 0;) {
    value = value * t + static_cast<long double>(p[n]);
  }
  return value;
}

/// Against the polynomial as it is rounded: never negative before the root found, and zero there.
TEST(FirstRoot, OfAnyRoots) {
  EXPECT_TRUE(rc::check([] {
    std::array<double, 8> roots{};
    for (double& root : roots) {
      const int choice = *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(-3000000, 3000000));
      root = choice < 0 ? -0.02 + 1e-6 * choice : 0.02 + 1e-6 * choice;
    }
    const auto p = with_roots<8>(roots);
    const double found = first_root(p, 1.0);
    std::array<double, 9> sizes{};
    std::transform(p.begin(), p.end(), sizes.begin(), [](double c) { return std::abs(c); });
    const long double rounding = 1e-15L * value_at(sizes, 1.0L);
    constexpr int points = 3000;
    for (int i = 0; i < points; ++i) {
      RC_ASSERT(value_at(p, static_cast<long double>(found) * i / points) >= -rounding);
    }
    RC_ASSERT(found == 1.0 || value_at(p, static_cast<long double>(found)) <= 2.0L * rounding);
  }));
}

}  // namespace
}  // namespace sonoglide::plant
