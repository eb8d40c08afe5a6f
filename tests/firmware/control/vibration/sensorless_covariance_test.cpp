/// The covariance of an observer of a felt mode, against the same as matrices.

#include "firmware/control/vibration/sensorless_covariance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <type_traits>

#include "scalars.hpp"

namespace sonoglide::control {
namespace {

using Vector = std::array<double, 4>;
using Matrix = std::array<Vector, 4>;

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t k = 0; k < 4; ++k) {
        c[i][j] += a[i][k] * b[k][j];
      }
    }
  }
  return c;
}

Matrix transposed(const Matrix& a) {
  Matrix b{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      b[i][j] = a[j][i];
    }
  }
  return b;
}

struct Variances {
  double mode_at_start = 4e-4;
  double mode_per_period = 1e-6;
  double mode_swing = 0.01;
  double mode_at_most = 0.2;
  double offset_at_start = 2e-4;
  double offset_per_period = 4e-6;
  double offset_at_most = 0.2;
};

template <class S>
typename SensorlessCovariance<S>::Parameters parameters(const Variances& all) {
  return {scaled<S>(all.mode_at_start),   scaled<S>(all.mode_per_period),
          scaled<S>(all.mode_swing),      scaled<S>(all.mode_at_most),
          scaled<S>(all.offset_at_start), scaled<S>(all.offset_per_period),
          scaled<S>(all.offset_at_most)};
}

/// The filter as it is written down.
struct Oracle {
  Variances all;
  Matrix p{};

  explicit Oracle(const Variances& variances) : all(variances) {
    p[0][0] = p[1][1] = all.mode_at_start;
    p[2][2] = all.offset_at_start;
    p[3][3] = 0.2;
  }

  void predict(double c, double s, const Vector& slope, const Vector& mode) {
    const Matrix f{{{c, -s, 0, slope[0]}, {s, c, 0, slope[1]}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
    p = product(product(f, p), transposed(f));
    const double more =
        all.mode_per_period + all.mode_swing * (mode[0] * mode[0] + mode[1] * mode[1]);
    p[0][0] += more;
    p[1][1] += more;
    p[2][2] += all.offset_per_period;
    p[3][3] += 1e-6;
    if (p[0][0] >= all.mode_at_most || p[1][1] >= all.mode_at_most ||
        p[2][2] >= all.offset_at_most || p[3][3] >= 0.25) {
      for (Vector& row : p) {
        std::transform(row.begin(), row.end(), row.begin(), [](double x) { return 0.25 * x; });
      }
    }
  }

  Vector update(const Vector& jacobian, double variance, double innovation) {
    Vector cross_covariance{};
    double sum = variance;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        cross_covariance[i] += p[i][j] * jacobian[j];
      }
      sum += jacobian[i] * cross_covariance[i];
    }
    const double deviations = innovation / std::sqrt(sum);
    const double limited = std::clamp(deviations, -3.0, 3.0);
    Vector moved{};
    for (std::size_t i = 0; i < 4; ++i) {
      moved[i] = cross_covariance[i] / std::sqrt(sum) * limited;
      for (std::size_t j = 0; j < 4; ++j) {
        p[i][j] -= cross_covariance[i] * cross_covariance[j] / sum;
      }
    }
    if (std::abs(deviations) >= 3.0) {
      p[0][0] += all.mode_at_start;
      p[1][1] += all.mode_at_start;
    }
    return moved;
  }
};

template <class S>
class SensorlessCovarianceTest : public testing::Test {};
TYPED_TEST_SUITE(SensorlessCovarianceTest, Scalars);

/// Runs both over random periods.
template <class S>
struct Together {
  std::mt19937_64 generator;
  Variances variances{};
  SensorlessCovariance<S> covariance{parameters<S>(variances)};
  Oracle oracle{variances};

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator);
  }

  void predict() {
    if (between(0.0, 1.0) < 0.02) {
      const S part = scaled<S>(between(0.0, 0.9));
      covariance.inflate_offset(part);
      oracle.p[2][2] =
          std::min(oracle.p[2][2] + numeric::to_real(part) * oracle.all.offset_at_start,
                   oracle.all.offset_at_most);
    }
    const double angle = between(-3.1, 3.1);
    constexpr double decay = 0.9999;
    const Pair<S> rotation{scaled<S>(decay * std::cos(angle)), scaled<S>(decay * std::sin(angle))};
    const double loud = between(0.0, 0.3);
    const Pair<S> slope{scaled<S>(between(-loud, loud)), scaled<S>(between(-loud, loud))};
    const Pair<S> mode{scaled<S>(between(-loud, loud)), scaled<S>(between(-loud, loud))};
    covariance.predict(rotation, slope, mode);
    oracle.predict(numeric::to_real(rotation.first), numeric::to_real(rotation.second),
                   {numeric::to_real(slope.first), numeric::to_real(slope.second)},
                   {numeric::to_real(mode.first), numeric::to_real(mode.second)});
  }

  void update(double tolerance) {
    const typename SensorlessCovariance<S>::State jacobian{
        {scaled<S>(between(-0.7, 0.7)), scaled<S>(between(-0.7, 0.7))},
        scaled<S>(0.25),
        scaled<S>(between(-0.3, 0.3))};
    const S variance = scaled<S>(std::exp(between(std::log(1e-7), std::log(1e-3))));
    const S innovation = scaled<S>(between(-0.05, 0.05));
    const auto moved = covariance.update(jacobian, variance, innovation);
    const Vector expected = oracle.update(
        {numeric::to_real(jacobian.mode.first), numeric::to_real(jacobian.mode.second),
         numeric::to_real(jacobian.offset), numeric::to_real(jacobian.frequency_parameter)},
        numeric::to_real(variance), numeric::to_real(innovation));
    EXPECT_NEAR(numeric::to_real(moved.mode.first), expected[0], tolerance);
    EXPECT_NEAR(numeric::to_real(moved.mode.second), expected[1], tolerance);
    EXPECT_NEAR(numeric::to_real(moved.offset), expected[2], tolerance);
    const double frequency_parameter = expected[3];
    EXPECT_NEAR(numeric::to_real(moved.frequency_parameter),
                numeric::is_fixed_point_v<S> ? std::clamp(frequency_parameter, -1.0, 1.0)
                                             : frequency_parameter,
                tolerance);
  }
};

TYPED_TEST(SensorlessCovarianceTest, MovesWhatTheFilterMovesThatIsWrittenDown) {
  constexpr bool exact = std::is_same_v<TypeParam, double>;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Together<TypeParam> together{std::mt19937_64(seed)};
    for (int period = 0; period < 200; ++period) {
      together.predict();
      if (together.between(0.0, 1.0) < 0.8) {
        together.update(exact ? 1e-10 : 2e-3);
      }
    }
  }
}

/// Without readings doubts grow for ever, and a base is never left.
TYPED_TEST(SensorlessCovarianceTest, StaysOnItsBaseForAsLongAsNothingIsRead) {
  Together<TypeParam> together{std::mt19937_64(1)};
  for (int period = 0; period < 100000; ++period) {
    together.predict();
  }
  together.update(std::is_same_v<TypeParam, double> ? 1e-8 : 0.02);
}

}  // namespace
}  // namespace sonoglide::control
