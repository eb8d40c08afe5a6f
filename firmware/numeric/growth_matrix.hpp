/// Exponential of a small matrix.
#pragma once

#include <array>
#include <cstddef>

#include "firmware/numeric/scalar.hpp"

namespace sonoglide::numeric {

template <class Scalar, std::size_t Size>
using SquareMatrix = std::array<std::array<Scalar, Size>, Size>;

/// Matrix product a b.
template <class Scalar, std::size_t Size>
SquareMatrix<Scalar, Size> product(const SquareMatrix<Scalar, Size>& a,
                                   const SquareMatrix<Scalar, Size>& b) {
  SquareMatrix<Scalar, Size> result{};
  for (std::size_t row = 0; row < Size; ++row) {
    for (std::size_t column = 0; column < Size; ++column) {
      for (std::size_t i = 0; i < Size; ++i) {
        result[row][column] += a[row][i] * b[i][column];
      }
    }
  }
  return result;
}

/// exp(time generator) - 1, for any real matrix: the growth of the state of z' = generator z in
/// `time`.
///
/// Taylor series of a halved time, then doubling by (1 + g)^2 - 1 = 2 g + g^2, which keeps the
/// digits of a small growth. Error <= 64 epsilon (doublings + 1), relative to the larger of 1 and
/// the largest entry of the exponential.
/// Source: C. Moler, C. Van Loan, SIAM Review 45 (2003) 3-49 (scaling and squaring).
template <class Scalar, std::size_t Size>
SquareMatrix<Scalar, Size> growth_matrix(const SquareMatrix<Scalar, Size>& generator, Scalar time) {
  constexpr int terms = 15;  // 2^-16 / 16! is below the rounding of double
  Scalar norm = Scalar(0);
  for (const auto& row : generator) {
    Scalar sum = Scalar(0);
    for (const Scalar entry : row) {
      sum += numeric::abs(entry);
    }
    norm = numeric::max(norm, sum * time);
  }
  const int exponent = numeric::split(norm).exponent;  // norm < 2^exponent
  const int doublings = exponent >= 0 ? exponent + 1 : 0;
  const Scalar reduced_time = numeric::scale_by_power_of_two(time, -doublings);

  SquareMatrix<Scalar, Size> growth{};
  // Horner's scheme: growth = (1 + growth) generator time / n, from the last term to the first.
  for (int n = terms; n > 0; --n) {
    SquareMatrix<Scalar, Size> sum = growth;
    for (std::size_t i = 0; i < Size; ++i) {
      sum[i][i] += Scalar(1);
    }
    growth = product(generator, sum);
    for (auto& row : growth) {
      for (Scalar& entry : row) {
        entry *= reduced_time / static_cast<Scalar>(n);
      }
    }
  }
  for (int i = 0; i < doublings; ++i) {
    const SquareMatrix<Scalar, Size> square = product(growth, growth);
    for (std::size_t row = 0; row < Size; ++row) {
      for (std::size_t column = 0; column < Size; ++column) {
        growth[row][column] += growth[row][column] + square[row][column];
      }
    }
  }
  return growth;
}

}  // namespace sonoglide::numeric
