// The closed form against quadrature in binary128, done another way: the contact's evolution is
// followed in phase, with a composite rule that resolves the relaxation behind each reversal.
#include <gtest/gtest.h>
#include <quadmath.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "firmware/friction/dahl_friction_ratio.hpp"

namespace {

__extension__ typedef __float128 Real;

const Real pi = acosq(-1);

Real travel_forward(Real r, Real turning, Real x) {
  return r * x + sinq(x - turning) + sinq(turning);
}
Real travel_backward(Real r, Real turning, Real x) {
  return sinq(turning) - sinq(turning + x) - r * x;
}

// Tanh–sinh over [0, length]: indifferent to where the integrand changes fast near an end.
template <class Function>
Real tanh_sinh(Real length, const Function& f) {
  const Real step = Real(1) / 128;
  Real sum = 0;
  for (int i = -128 * 5; i <= 128 * 5; ++i) {
    const Real t = i * step;
    const Real s = pi / 2 * sinhq(t);
    const Real x = length / (1 + expq(-2 * s));
    const Real weight = pi / 2 * coshq(t) / (coshq(s) * coshq(s));
    sum += weight * f(x);
  }
  return sum * step * length / 2;
}

Real relaxation(Real a, Real length, Real total, Real (*travel)(Real, Real, Real), Real r,
                Real turning) {
  // Beyond a travel of 90 nothing is left in binary128: cut there, so that no node is wasted.
  Real cut = length;
  if (a * total > 90) {
    Real low = 0;
    for (int i = 0; i < 200; ++i) {
      const Real middle = (low + cut) / 2;
      (a * travel(r, turning, middle) < 90 ? low : cut) = middle;
    }
  }
  return tanh_sinh(cut, [&](Real x) { return expq(-a * travel(r, turning, x)); });
}

Real reference(Real r, Real a) {
  const Real turning = acosq(-r);
  const Real forward = 2 * turning;
  const Real backward = 2 * (pi - turning);
  const Real uf = 2 * (r * turning + sqrtq(1 - r * r));
  const Real ub = uf - 2 * pi * r;
  const Real closing = -expm1q(-a * (uf + ub));
  const Real p = -2 * expm1q(-a * ub) / closing;
  const Real q = -2 * expm1q(-a * uf) / closing;
  const Real jf = relaxation(a, forward, uf, travel_forward, r, turning);
  const Real jb = relaxation(a, backward, ub, travel_backward, r, turning);
  return (forward - p * jf - backward + q * jb) / (2 * pi);
}

TEST(DahlFrictionRatio, IsWithin1e12OfBinary128) {
  std::mt19937_64 random(20130201);
  std::uniform_real_distribution<double> exponent(-4.0, 7.0);
  std::uniform_real_distribution<double> ratio(0.0, 1.0);
  double worst = 0.0;
  for (int i = 0; i < 400; ++i) {
    const double a = std::pow(10.0, exponent(random));
    // Uniform, and crowded towards both ends.
    double r = ratio(random);
    if (i % 4 == 1) {
      r = std::pow(10.0, -6.0 * r);
    } else if (i % 4 == 2) {
      r = 1.0 - std::pow(10.0, -1.0 - 8.0 * r);
    }
    const double error = std::abs(static_cast<double>(
        static_cast<Real>(sonoglide::friction::dahl_friction_ratio(r, a)) - reference(r, a)));
    EXPECT_LE(error, 1e-12) << "r " << r << " a " << a;
    worst = std::max(worst, error);
  }
  RecordProperty("worst_error", std::to_string(worst * 1e15) + "e-15");
}

}  // namespace
