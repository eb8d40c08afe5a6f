/// The plant of a unit, fitted to what it recorded.
#pragma once

#include <Eigen/Core>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "host_sim/configure/experiment.hpp"
#include "host_sim/studies/identify/identification.hpp"
#include "host_sim/studies/identify/plant/stretch.hpp"

namespace sonoglide::identify::plant {

struct PlantFit {
  Identification identification;  ///< names are keys of the scene; what is open is not a number
  /// Keys with their values, where the interval does not have what the scene states.
  std::vector<std::pair<std::string, double>> changed;
  std::vector<Eigen::VectorXd> modelled;  ///< readings of each stretch, over full scale
  double expected_rms = 0.0;  ///< of the residuals, by the scene's sensor; over full scale
};

/// Least squares over all readings. Intervals are those of the linearised model, with the values of every spring
/// that the readings do not tell from the best one.
///
/// @param nominal    of the scene that the recorded controller was designed for
/// @param stretches  the first of them undriven
/// @param progress   is told the part done
/// @throws loop::ComputationError  the undriven readings are those of no sliding contact
PlantFit fit_plant(const configure::Experiment& nominal, const std::vector<Stretch>& stretches,
                   const std::function<void(double)>& progress);

}  // namespace sonoglide::identify::plant
