/// Errors in units in the last place, and the arguments at which they are looked for.
#pragma once

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace sonoglide::numeric {

/// |got - wanted| in units in the last place of Float at `wanted`; 0 where both are NaN or the same
/// infinity, infinite where only one is.
template <class Float>
double error_in_ulp(Float got, long double wanted) {
  using Limits = std::numeric_limits<Float>;
  const auto rounded = static_cast<Float>(wanted);
  if (std::isnan(wanted) || std::isinf(rounded)) {
    const bool same = std::isnan(wanted) ? std::isnan(got) : got == rounded;
    return same ? 0.0 : std::numeric_limits<double>::infinity();
  }
  int exponent = Limits::min_exponent;
  if (std::fabs(wanted) > static_cast<long double>(Limits::min())) {
    std::frexp(wanted, &exponent);
  }
  const long double ulp = std::ldexp(1.0L, exponent - Limits::digits);
  const double error = static_cast<double>(std::fabs(static_cast<long double>(got) - wanted) / ulp);
  return std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
}

/// Arguments in [low, high]: evenly spread, crowded geometrically at zero if that lies inside, and
/// both ends with their neighbours.
template <class Float>
std::vector<Float> arguments(double low, double high, int count = 300'000) {
  std::mt19937_64 random(20131);
  const auto fraction = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  std::vector<Float> result;
  const auto add = [&](double x) {
    if (x >= low && x <= high) {
      result.push_back(static_cast<Float>(x));
    }
  };
  for (int i = 0; i < count; ++i) {
    add(low + (high - low) * fraction());
    const double small = std::exp2(-std::numeric_limits<Float>::max_exponent * fraction());
    add(high * small);
    add(low * small);
  }
  for (const double end : {low, high}) {
    Float below = static_cast<Float>(end);
    Float above = below;
    for (int i = 0; i < 1000; ++i) {
      add(static_cast<double>(below));
      add(static_cast<double>(above));
      below = std::nextafter(below, -std::numeric_limits<Float>::infinity());
      above = std::nextafter(above, std::numeric_limits<Float>::infinity());
    }
  }
  return result;
}

/// Largest error of `function` against `reference`, a function of long double.
template <class Float, class Function, class Reference>
double worst_ulp(const std::vector<Float>& at, Function function, Reference reference) {
  double worst = 0.0;
  for (const Float x : at) {
    const double error = error_in_ulp<Float>(function(x), reference(static_cast<long double>(x)));
    worst = error > worst ? error : worst;
  }
  return worst;
}

}  // namespace sonoglide::numeric
