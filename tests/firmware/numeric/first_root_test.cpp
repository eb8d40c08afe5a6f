/// The first root of polynomials whose roots are known.

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "firmware/numeric/first_root.hpp"

namespace sonoglide::numeric::first_root_test {
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
  EXPECT_NEAR(numeric::first_root(with_roots<3>({0.25, 2.0, -3.0}), 1.0), 0.25, 1e-15);
  EXPECT_NEAR(numeric::first_root(with_roots<5>({0.9, 0.3, 0.6, -1.0, 4.0}), 1.0), 0.3, 1e-14);
}

TEST(FirstRoot, NoneIsTheEnd) {
  EXPECT_EQ(numeric::first_root(with_roots<3>({1.1, 2.0, 3.0}), 1.0), 1.0);
  EXPECT_EQ(numeric::first_root(with_roots<3>({-0.1, -0.2, -0.3}), 1.0), 1.0);
  EXPECT_EQ(numeric::first_root(std::array<double, 4>{1.0, 0.0, 0.0, 0.0}, 1.0), 1.0);
  EXPECT_EQ(numeric::first_root(std::array<double, 4>{0.01, -0.1, 1.0, 0.0}, 1.0), 1.0);
}

TEST(FirstRoot, OfANarrowPair) {
  for (const double gap : {1e-1, 1e-3, 1e-5, 1e-7}) {
    EXPECT_NEAR(numeric::first_root(with_roots<4>({0.5, 0.5 + gap, 5.0, -7.0}), 1.0), 0.5, 1e-7)
        << gap;
  }
}

TEST(FirstRoot, OfADoubleRoot) {
  EXPECT_NEAR(numeric::first_root(with_roots<4>({0.5, 0.5, 5.0, -7.0}), 1.0), 0.5, 1e-7);
}

/// Met in float: the terms are small only because time is. Without units of its own the search went
/// round for ever, the squares of its slopes being zero.
TEST(FirstRoot, OfTinyTermsInTinyTime) {
  const std::array<float, 9> p = {8.59829637e-31F, -1.22033408e-26F, -5.87206475e-23F,
                                  1.26621375e-18F, -6.6012671e-16F,  -3.18585713e-11F,
                                  6.56613537e-08F, 0.000302217028F,  -1.0F};
  const float end = 2.31482802e-4F;
  std::array<double, 9> exact{};
  std::copy(p.begin(), p.end(), exact.begin());
  EXPECT_NEAR(numeric::first_root(p, end), numeric::first_root(exact, static_cast<double>(end)),
              1e-6F * end);
}

/// Met in float: a mass that friction stops at once, its ringing written in powers of a time that
/// is a million times longer.
TEST(FirstRoot, OfATinyValueBesideTermsThatOnlyTimeMakesSmall) {
  const std::array<float, 13> p = {1.21614e-10F, -3.23578e7F,  472605.0F,   1.74504e14F,
                                   -2.54873e12F, -2.82327e20F, 4.12355e18F, 2.17511e26F,
                                   -3.17687e24F, -9.77519e31F, 1.42772e30F, 2.87548e37F,
                                   -4.1998e35F};
  EXPECT_NEAR(numeric::first_root(p, 2.94772e-6F), p[0] / -p[1], 1e-6F * p[0] / -p[1]);
}

/// Units of time and of p change nothing.
TEST(FirstRoot, DoesNotDependOnTheUnitOfTime) {
  for (const float size : {1e-25F, 1e-12F, 1.0F}) {
    for (const float unit : {1e-4F, 1e-2F, 1.0F, 1e2F}) {
      std::array<float, 6> p{};
      const auto exact = with_roots<5>({0.5, 0.52, 3.0, -0.7, 4.0});
      float power = size;
      for (std::size_t n = 0; n < p.size(); ++n) {
        p[n] = static_cast<float>(exact[n]) * power;
        power /= unit;
      }
      EXPECT_NEAR(numeric::first_root(p, unit) / unit, 0.5F, 2e-4F) << size << ' ' << unit;
    }
  }
}

TEST(FirstRoot, DoesNotDependOnTheSizeOfThePolynomial) {
  for (const double size : {1e-300, 1e-200, 1e-100, 1e100, 1e200, 1e300}) {
    auto p = with_roots<4>({0.5, 0.8, 5.0, -7.0});
    for (double& coefficient : p) {
      coefficient *= size;
    }
    EXPECT_NEAR(numeric::first_root(p, 1.0), 0.5, 1e-14) << size;
  }
}

TEST(FirstRoot, CloseToTheBeginning) {
  EXPECT_NEAR(numeric::first_root(with_roots<3>({1e-12, 0.5, 2.0}), 1.0) / 1e-12, 1.0, 1e-3);
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
    const double found = numeric::first_root(p, 1.0);
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

TEST(FirstRoot, WithoutAZeroAtTheBeginning) {
  // -t^2 (t - 0.25) (t - 2) (t + 3) falls into the first quarter.
  std::array<double, 6> p{};
  const auto cubic = with_roots<3>({0.25, 2.0, -3.0});
  std::copy(cubic.begin(), cubic.end(), p.begin() + 2);
  for (double& coefficient : p) {
    coefficient = -coefficient;
  }
  EXPECT_NEAR(numeric::first_root(numeric::without_zero(p, -1.0, 2), 1.0), 0.25, 1e-15);
}

}  // namespace
}  // namespace sonoglide::numeric::first_root_test
