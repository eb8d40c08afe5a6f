/// The oscillator without its contact over a panel of time: a basis of its motions.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include "firmware/numeric/economised.hpp"
#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/lane_polynomial.hpp"
#include "firmware/numeric/lanes.hpp"
#include "firmware/numeric/power_series.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/plant/drive.hpp"
#include "firmware/plant/model.hpp"
#include "firmware/plant/ramped_cosine.hpp"

namespace sonoglide::plant {

/// Grid points of a panel; the same for every order of the series.
struct PanelGrid {
  static constexpr std::size_t intervals = 16;
  static constexpr std::size_t points = intervals + 1;
  static constexpr std::size_t padded = 20;  ///< whole lanes
  /// spacing^2 / 8: of a second derivative, what a straight line between two points can miss.
  template <class Scalar>
  static constexpr Scalar hidden = Scalar(1) / static_cast<Scalar>(2 * intervals * intervals);
};

/// Motions in x, from -1 to 1 over a panel of time: with h half of its length,
///   y" + D y' + K y = h^2 drive,  D = d h, K = k h^2, ' = d / dx:
/// C(0) = 1, C'(0) = 0 and S(0) = 0, S'(0) = 1 without drive; where there is one, two more from
/// rest at x = 0, under cos(h x) and under sin(h x); where its amplitude may change, three more, under
/// x cos(h x), under x sin(h x) and under 1.
///
/// Power series with no division by k, k - 1 or d: resonance, a free mass and an overdamped
/// oscillator are alike. They are shortened by Chebyshev polynomials to `Degree`; C and S once
/// more, to `SlowDegree`, for what friction adds to the motion, which is small.
template <class Model, std::size_t Degree, std::size_t SlowDegree>
struct PanelMotions {
  using Scalar = typename Model::Scalar;
  using Lanes = numeric::Lanes<Scalar>;
  static constexpr bool is_driven = !std::is_same_v<typename Model::Drive, NoDrive>;
  static constexpr bool is_ramped = std::is_same_v<typename Model::Drive, RampedCosineDrive>;
  /// Without damping C is even and S odd, and so are the two that the drive adds.
  static constexpr bool is_split = std::is_base_of_v<Undamped<Scalar>, Model>;
  static constexpr std::size_t count = is_ramped ? 7 : is_driven ? 4 : 2;
  static constexpr std::size_t wave_count = is_ramped ? 5 : 2;
  static constexpr std::size_t harmonic_degree = Degree - 4;

  struct End {
    Scalar value;
    Scalar rate;
  };
  using Each = std::array<Scalar, count>;
  struct Products {
    std::array<Each, count> motion{};     ///< integrals over x of products of two motions
    std::array<Each, wave_count> wave{};  ///< of motions and cos(h x), sin(h x), …
  };
  struct alignas(16) OnGrid : std::array<Scalar, PanelGrid::padded> {};

  Scalar half_length = Scalar(0);
  Scalar stiffness = Scalar(0);  ///< K
  Scalar damping = Scalar(0);    ///< D
  std::array<numeric::LanePolynomial<Scalar, Degree>, count> motion{};
  std::array<numeric::LanePolynomial<Scalar, SlowDegree>, 2> slow{};
  std::array<numeric::LanePolynomial<Scalar, harmonic_degree>, 2>
      harmonic{};  ///< cos(h x), sin(h x)
  std::array<End, count> begin{};
  std::array<End, count> end{};
  std::array<OnGrid, count> rate{};  ///< y' on the grid
  std::array<OnGrid, count> bend{};  ///< y"
  OnGrid since_begin{};              ///< x + 1
  Each third{};                      ///< bounds of |y"'|
  Each fourth{};                     ///< and of |y""|
  /// Bounds of |C| and |S|, and of the motion under 1 where there is one.
  std::array<Scalar, is_ramped ? 3 : 2> largest{};
  std::array<Scalar, 2> largest_rate{};  ///< and of |C'| and |S'|
  Each error{};                          ///< bounds of what the shortening loses of each
  Scalar slow_error = Scalar(0);
  std::array<Scalar, 2> harmonic_end{};  ///< cos(h), sin(h)

  PanelMotions() = default;
  PanelMotions(const Model& model, Scalar panel_half_length)
      : half_length(panel_half_length),
        stiffness(model.stiffness * half_length * half_length),
        damping(model.damping_force(half_length)) {
    const std::array<Series, wave_count> waves = this->waves();
    const std::array<Series, count> series = all_series(waves);
    for (std::size_t g = 0; g < PanelGrid::points; ++g) {
      since_begin[g] = grid(g) + Scalar(1);
    }
    for (std::size_t m = 0; m < count; ++m) {
      tabulate(m, series[m]);
      error[m] = shorten(series[m], motion[m]) + numeric::abs(series[m][terms - 1]);
    }
    for (std::size_t m = 0; m < 2; ++m) {
      largest[m] = bound(series[m]);
      largest_rate[m] = bound(numeric::derivative<1>(series[m]));
      slow_error += shorten(series[m], slow[m]);
      shorten(waves[m], harmonic[m]);
      harmonic_end[m] = numeric::evaluate(waves[m], Scalar(1));
    }
    if constexpr (is_ramped) {
      largest[2] = bound(series[6]);
    }
  }

  /// What energies take. Nobody else waits for it: it is made when it is first asked for.
  const Products& products() const {
    if (!has_products_) {
      make_products();
      has_products_ = true;
    }
    return products_;
  }

  /// C(x) and S(x), to the lower degree.
  template <class Numbers>
  [[gnu::always_inline]] Numbers slow_c(Numbers x) const {
    if constexpr (is_split) {
      return numeric::half_value<numeric::Parity::even>(slow[0], x * x);
    } else {
      return numeric::value_at(slow[0], x);
    }
  }
  template <class Numbers>
  [[gnu::always_inline]] Numbers slow_s(Numbers x) const {
    if constexpr (is_split) {
      return x * numeric::half_value<numeric::Parity::odd>(slow[1], x * x);
    } else {
      return numeric::value_at(slow[1], x);
    }
  }

  [[gnu::always_inline]] Lanes cosine(Lanes x) const {
    return numeric::half_value<numeric::Parity::even>(harmonic[0], x * x);
  }
  [[gnu::always_inline]] Lanes sine(Lanes x) const {
    return x * numeric::half_value<numeric::Parity::odd>(harmonic[1], x * x);
  }

  /// f over the Wronskian C S' - C' S = exp(-D x), at a place where C and S are known.
  template <class Number>
  [[gnu::always_inline]] Number unwound(Number f, Number c, Number s) const {
    if constexpr (is_split) {
      return f;
    } else {
      return f / (c * (c - damping * s) + stiffness * (s * s));
    }
  }

  /// The sum of the motions, with these shares of each.
  [[gnu::always_inline]] numeric::LanePolynomial<Scalar, Degree> sum(const Each& share) const {
    numeric::LanePolynomial<Scalar, Degree> path{};
    for (std::size_t n = 0; n <= Degree; ++n) {
      path[n] = is_split ? share[n % 2] * motion[n % 2][n]
                         : share[0] * motion[0][n] + share[1] * motion[1][n];
      if constexpr (is_driven) {
        path[n] += is_split ? share[2 + n % 2] * motion[2 + n % 2][n]
                            : share[2] * motion[2][n] + share[3] * motion[3][n];
      }
      if constexpr (is_ramped) {
        path[n] += share[4] * motion[4][n] + share[5] * motion[5][n] + share[6] * motion[6][n];
      }
    }
    return path;
  }

  /// The same of one number or lane for each motion.
  template <class Of>
  [[gnu::always_inline]] static auto sum_of(const Each& share, const Of& of) {
    auto total = share[0] * of(0) + share[1] * of(1);
    if constexpr (is_driven) {
      total += share[2] * of(2) + share[3] * of(3);
    }
    if constexpr (is_ramped) {
      total += share[4] * of(4) + share[5] * of(5) + share[6] * of(6);
    }
    return total;
  }

 private:
  static constexpr std::size_t terms = 33;
  using Series = std::array<Scalar, terms>;

  std::array<Series, wave_count> waves() const {
    std::array<Series, wave_count> all{wave(Scalar(1), Scalar(0)), wave(Scalar(0), half_length)};
    if constexpr (is_ramped) {
      for (std::size_t n = 1; n < terms; ++n) {
        all[2][n] = all[0][n - 1];
        all[3][n] = all[1][n - 1];
      }
      all[4][0] = Scalar(1);
    }
    return all;
  }

  std::array<Series, count> all_series(const std::array<Series, wave_count>& waves) const {
    std::array<Series, count> all{};
    all[0] = solution(Scalar(1), Scalar(0), Series{});
    all[1] = solution(Scalar(0), Scalar(1), Series{});
    for (std::size_t m = 2; m < count; ++m) {
      all[m] = solution(Scalar(0), Scalar(0), waves[m - 2]);
    }
    return all;
  }

  [[gnu::noinline]] void make_products() const {
    const std::array<Series, wave_count> waves = this->waves();
    const std::array<Series, count> series = all_series(waves);
    for (std::size_t m = 0; m < count; ++m) {
      for (std::size_t n = 0; n < count; ++n) {
        products_.motion[m][n] = integral_of_product(series[m], series[n]);
      }
      for (std::size_t n = 0; n < wave_count; ++n) {
        products_.wave[n][m] = integral_of_product(series[m], waves[n]);
      }
    }
  }

  /// Returns a bound of the error of the shortening.
  template <std::size_t Count>
  static Scalar shorten(const Series& series, std::array<numeric::Lanes<Scalar>, Count>& lanes) {
    std::array<Scalar, Count> shortened{};
    const Scalar lost = numeric::economise(series, shortened);
    for (std::size_t n = 0; n < Count; ++n) {
      lanes[n] = numeric::broadcast(shortened[n]);
    }
    return lost;
  }

  /// w" = -h^2 w.
  Series wave(Scalar value, Scalar slope) const {
    Series w{};
    w[0] = value;
    w[1] = slope;
    for (std::size_t n = 2; n < terms; ++n) {
      w[n] = -w[n - 2] * half_length * half_length * numeric::reciprocal<Scalar>(n) *
             numeric::reciprocal<Scalar>(n - 1);
    }
    return w;
  }

  Series solution(Scalar value, Scalar slope, const Series& drive) const {
    const Scalar square = half_length * half_length;
    Series y{};
    y[0] = value;
    y[1] = slope;
    for (std::size_t n = 0; n + 2 < terms; ++n) {
      const Scalar pull = damping * static_cast<Scalar>(n + 1) * y[n + 1] + stiffness * y[n];
      y[n + 2] = (square * drive[n] - pull) * numeric::reciprocal<Scalar>(n + 1) *
                 numeric::reciprocal<Scalar>(n + 2);
    }
    return y;
  }

  void tabulate(std::size_t m, const Series& y) {
    const auto first = numeric::derivative<1>(y);
    const auto second = numeric::derivative<1>(first);
    const auto third_derivative = numeric::derivative<1>(second);
    const auto fourth_derivative = numeric::derivative<1>(third_derivative);
    for (std::size_t g = 0; g < PanelGrid::points; ++g) {
      rate[m][g] = numeric::evaluate(first, grid(g));
      bend[m][g] = numeric::evaluate(second, grid(g));
    }
    begin[m] = {numeric::evaluate(y, Scalar(-1)), rate[m][0]};
    end[m] = {numeric::evaluate(y, Scalar(1)), rate[m][PanelGrid::intervals]};
    third[m] = bound(third_derivative);
    fourth[m] = bound(fourth_derivative);
  }

  static Scalar grid(std::size_t g) {
    constexpr Scalar spacing = Scalar(2) / static_cast<Scalar>(PanelGrid::intervals);
    return spacing * static_cast<Scalar>(g) - Scalar(1);
  }

  /// Bound of |p| on the panel: the largest value on the grid, plus what a parabola can hide
  /// between two points.
  template <std::size_t Count>
  static Scalar bound(const std::array<Scalar, Count>& p) {
    const auto second = numeric::derivative<1>(numeric::derivative<1>(p));
    Scalar largest = Scalar(0);
    Scalar bend_bound = Scalar(0);
    for (std::size_t g = 0; g < PanelGrid::points; ++g) {
      largest = numeric::max(largest, numeric::abs(numeric::evaluate(p, grid(g))));
    }
    for (const Scalar coefficient : second) {
      bend_bound += numeric::abs(coefficient);
    }
    return largest + PanelGrid::hidden<Scalar> * bend_bound;
  }

  static Scalar integral_of_product(const Series& p, const Series& q) {
    Scalar sum = Scalar(0);
    for (std::size_t m = 0; m < terms; ++m) {
      for (std::size_t n = m % 2; n < terms && m + n + 1 < 64; n += 2) {
        sum += p[m] * q[n] * numeric::twice(numeric::reciprocal<Scalar>(m + n + 1));
      }
    }
    return sum;
  }

  mutable Products products_{};
  mutable bool has_products_ = false;
};

}  // namespace sonoglide::plant
