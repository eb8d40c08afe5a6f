/// The covariance of an observer of a felt mode, against the same as matrices.

#include "firmware/control/felt_doubt.hpp"

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
typename FeltDoubt<S>::Parameters parameters(const Variances& all) {
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

  void pass(double c, double s, const Vector& slope, const Vector& mode) {
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

  Vector weigh(const Vector& view, double variance, double miss) {
    Vector seen{};
    double sum = variance;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        seen[i] += p[i][j] * view[j];
      }
      sum += view[i] * seen[i];
    }
    const double deviations = miss / std::sqrt(sum);
    const double limited = std::clamp(deviations, -3.0, 3.0);
    Vector moved{};
    for (std::size_t i = 0; i < 4; ++i) {
      moved[i] = seen[i] / std::sqrt(sum) * limited;
      for (std::size_t j = 0; j < 4; ++j) {
        p[i][j] -= seen[i] * seen[j] / sum;
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
class FeltDoubtTest : public testing::Test {};
TYPED_TEST_SUITE(FeltDoubtTest, Scalars);

/// Runs both over random periods.
template <class S>
struct Together {
  std::mt19937_64 generator;
  Variances variances{};
  FeltDoubt<S> doubt{parameters<S>(variances)};
  Oracle oracle{variances};

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator);
  }

  void pass() {
    if (between(0.0, 1.0) < 0.02) {
      const S part = scaled<S>(between(0.0, 0.9));
      doubt.doubt_offset(part);
      oracle.p[2][2] =
          std::min(oracle.p[2][2] + numeric::to_real(part) * oracle.all.offset_at_start,
                   oracle.all.offset_at_most);
    }
    const double angle = between(-3.1, 3.1);
    constexpr double decay = 0.9999;
    const Pair<S> turn{scaled<S>(decay * std::cos(angle)), scaled<S>(decay * std::sin(angle))};
    const double loud = between(0.0, 0.3);
    const Pair<S> slope{scaled<S>(between(-loud, loud)), scaled<S>(between(-loud, loud))};
    const Pair<S> mode{scaled<S>(between(-loud, loud)), scaled<S>(between(-loud, loud))};
    doubt.pass(turn, slope, mode);
    oracle.pass(numeric::to_real(turn.first), numeric::to_real(turn.second),
                {numeric::to_real(slope.first), numeric::to_real(slope.second)},
                {numeric::to_real(mode.first), numeric::to_real(mode.second)});
  }

  void weigh(double tolerance) {
    const typename FeltDoubt<S>::State view{
        {scaled<S>(between(-0.7, 0.7)), scaled<S>(between(-0.7, 0.7))},
        scaled<S>(0.25),
        scaled<S>(between(-0.3, 0.3))};
    const S variance = scaled<S>(std::exp(between(std::log(1e-7), std::log(1e-3))));
    const S miss = scaled<S>(between(-0.05, 0.05));
    const auto moved = doubt.weigh(view, variance, miss);
    const Vector expected =
        oracle.weigh({numeric::to_real(view.mode.first), numeric::to_real(view.mode.second),
                      numeric::to_real(view.offset), numeric::to_real(view.place)},
                     numeric::to_real(variance), numeric::to_real(miss));
    EXPECT_NEAR(numeric::to_real(moved.mode.first), expected[0], tolerance);
    EXPECT_NEAR(numeric::to_real(moved.mode.second), expected[1], tolerance);
    EXPECT_NEAR(numeric::to_real(moved.offset), expected[2], tolerance);
    const double place = expected[3];
    EXPECT_NEAR(numeric::to_real(moved.place),
                numeric::is_fixed_point_v<S> ? std::clamp(place, -1.0, 1.0) : place, tolerance);
  }
};

TYPED_TEST(FeltDoubtTest, MovesWhatTheFilterMovesThatIsWrittenDown) {
  constexpr bool exact = std::is_same_v<TypeParam, double>;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Together<TypeParam> together{std::mt19937_64(seed)};
    for (int period = 0; period < 200; ++period) {
      together.pass();
      if (together.between(0.0, 1.0) < 0.8) {
        together.weigh(exact ? 1e-10 : 2e-3);
      }
    }
  }
}

/// Without readings doubts grow for ever, and a base is never left.
TYPED_TEST(FeltDoubtTest, StaysOnItsBaseForAsLongAsNothingIsRead) {
  Together<TypeParam> together{std::mt19937_64(1)};
  for (int period = 0; period < 100000; ++period) {
    together.pass();
  }
  together.weigh(std::is_same_v<TypeParam, double> ? 1e-8 : 0.02);
}

}  // namespace
}  // namespace sonoglide::control
