#pragma once

#include <Eigen/Core>
#include <cmath>

namespace sonoglide::configure {

/// Largest modulus of the eigenvalues of a matrix that is not nilpotent, by Gelfand's formula with the
/// power 2^20, which is off by 1e-5 or so. Eigen's solver takes ten seconds to compile without
/// optimisation.
inline double spectral_radius(Eigen::Matrix3d matrix) {
  double logarithm = 0.0;
  double share = 1.0;
  constexpr int squarings = 20;
  for (int i = 0; i < squarings; ++i) {
    const double norm = matrix.norm();
    logarithm += share * std::log(norm);
    share *= 0.5;
    matrix = (matrix / norm).eval() * (matrix / norm).eval();
  }
  return std::exp(logarithm + share * std::log(matrix.norm()));
}

}  // namespace sonoglide::configure
