/// How sure the readings of a unit make a fit of its plant.
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <vector>

#include "host_sim/scene/scene.hpp"
#include "host_sim/studies/identify/least_squares.hpp"
#include "host_sim/studies/identify/plant/stretch.hpp"

namespace sonoglide::identify::plant {

/// Standard deviations of a reading by the scene's sensor, over full scale.
struct Expected {
  double noise;
  double rounding;

  double deviation() const { return std::hypot(noise, rounding); }
  double quantum() const { return std::sqrt(12.0) * rounding; }  ///< one code
  /// Whether a reading is so few codes, which no noise stirs, that their rounding is no noise: the fit may then be
  /// of another plant.
  bool rounds_coarsely(double reading) const {
    return noise < rounding && std::abs(reading) < fewest_codes * quantum();
  }

  static constexpr double fewest_codes = 40.0;
};
Expected expected(const scene::Sensor& sensor);

/// How many times the variance of a mean of residuals is that of independent ones, at least 1: the initial
/// positive sequence of their correlations.
/// Source: Geyer, "Practical Markov chain Monte Carlo", Statistical Science 7 (1992).
double correlation_factor(const Eigen::VectorXd& residuals);

struct Deviations {
  Eigen::VectorXd of_parameters;
  double student;  ///< as many of them reach to the ends of a 95 % interval
  Eigen::MatrixXd covariance;
};

/// Of the model that is linear about the fit. Residuals count as large as they are seen to be, or as the sensor
/// makes them.
/// @param slopes  of the residuals to the parameters
Deviations deviations(const LeastSquaresFit& fit, const Eigen::MatrixXd& slopes,
                      const std::vector<Stretch>& stretches, const Expected& expected);

}  // namespace sonoglide::identify::plant
