/// The friction-ratio maps of Iwan and LuGre against contacts that are followed in short steps.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "firmware/friction/coulomb_friction_ratio.hpp"
#include "firmware/friction/dahl_friction_ratio.hpp"
#include "firmware/friction/iwan_friction_ratio.hpp"
#include "firmware/friction/lugre_friction_ratio.hpp"

namespace sonoglide::friction::further_ratio_maps_test {
namespace {

constexpr double two_pi = 6.283185307179586;

/// Mean force of springs that slip, over the last of some periods of a sine.
double followed_springs(double ratio, double stiffness, int elements) {
  std::array<double, 8> forces{};
  constexpr int steps = 4000;
  const int periods = 2 + static_cast<int>(elements * 0.8 / (stiffness * ratio));
  double mean = 0.0;
  for (int step = 0; step < periods * steps; ++step) {
    const double travel = ratio * two_pi / steps + std::sin(two_pi * (step + 1) / steps) -
                          std::sin(two_pi * step / steps);
    mean = step % steps == 0 ? 0.0 : mean;
    for (int i = 0; i < elements; ++i) {
      const double limit = (2.0 * i + 1.0) / (elements * elements);
      double& force = forces[static_cast<std::size_t>(i)];
      const double before = force;
      force = std::clamp(force + stiffness / elements * travel, -limit, limit);
      mean += 0.5 * (before + force) / steps;
    }
  }
  return mean;
}

TEST(IwanFrictionRatio, IsThatOfSpringsFollowedInShortSteps) {
  for (const double ratio : {0.05, 0.3, 0.5, 0.9}) {
    for (const double stiffness : {0.3, 0.9, 2.0, 20.0}) {
      for (const int elements : {1, 3, 8}) {
        EXPECT_NEAR(iwan_friction_ratio(ratio, stiffness, static_cast<std::size_t>(elements)),
                    followed_springs(ratio, stiffness, elements), 2e-5)
            << ratio << ' ' << stiffness << ' ' << elements;
      }
    }
  }
}

TEST(IwanFrictionRatio, HasItsLimits) {
  for (const double stiffness : {1e-4, 0.3, 0.9, 1.5, 10.0}) {
    EXPECT_NEAR(iwan_friction_ratio(1e-9, stiffness, 1), std::max(0.0, 1.0 - stiffness), 1e-7);
  }
  for (const double ratio : {0.1, 0.5, 0.95}) {
    EXPECT_NEAR(iwan_friction_ratio(ratio, 1e6, 8), coulomb_friction_ratio(ratio), 1e-4);
  }
  EXPECT_EQ(iwan_friction_ratio(1.0, 0.3, 1), 1.0);
}

/// psi in the same steps everywhere, far shorter ones, with its exact decay in each.
double followed_bristles(double ratio, const LuGreShape& contact) {
  constexpr int steps = 20000;
  double start = 0.0;
  double mean = 0.0;
  for (int pass = 0; pass < 2; ++pass) {
    double psi = start;
    double left_of_start = 1.0;
    mean = 0.0;
    for (int step = 0; step < steps; ++step) {
      const double velocity = ratio + std::cos(two_pi * (step + 0.5) / steps);
      const double curve = contact.curve(velocity);
      const double level = velocity < 0.0 ? -curve : curve;
      const double decay = contact.contact_stiffness * std::abs(velocity) * two_pi / steps / curve;
      const double share = decay > 0.0 ? -std::expm1(-decay) / decay : 1.0;
      mean += (level + (psi - level) * share) / steps;
      psi = level + (psi - level) * std::exp(-decay);
      left_of_start *= std::exp(-decay);
    }
    start = psi / (1.0 - left_of_start);
  }
  return mean + contact.viscous_friction * ratio;
}

TEST(LuGreMeanFriction, IsThatOfFarShorterSteps) {
  for (const double ratio : {0.02, 0.3, 0.9, 1.0, 1.01, 3.0}) {
    for (const double stiffness : {1e-3, 1.0, 10.0, 100.0, 1e4}) {
      for (const double still : {1.0, 3.0}) {
        for (const double velocity : {0.05, 0.2, 1.0, 5.0}) {
          const LuGreShape contact{stiffness, still, velocity, 0.1};
          EXPECT_NEAR(lugre_mean_friction(ratio, contact), followed_bristles(ratio, contact), 3e-3)
              << ratio << ' ' << stiffness << ' ' << still << ' ' << velocity;
        }
      }
    }
  }
}

TEST(LuGreMeanFriction, IsDahlsWithoutAStaticFriction) {
  for (const double ratio : {0.1, 0.5, 0.93}) {
    for (const double stiffness : {1e-3, 0.4, 10.0, 1e3}) {
      EXPECT_NEAR(lugre_mean_friction(ratio, {stiffness, 1.0, 0.3, 0.2}),
                  dahl_friction_ratio(ratio, stiffness) + 0.2 * ratio, 5e-4);
    }
  }
}

}  // namespace
}  // namespace sonoglide::friction::further_ratio_maps_test
