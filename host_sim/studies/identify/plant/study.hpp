/// The identification of the plant that a unit drives: what it is asked for, and what comes of it.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "host_sim/configure/experiment.hpp"
#include "host_sim/output/study_report.hpp"
#include "host_sim/report/step_metrics.hpp"
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

/// @throws configure::ConfigurationError  what of a scene keeps its plant from being identified while it is driven
void require_identifiable(const configure::Experiment& experiment);

/// Targets that a unit of the scene is given one after the other, from the first on: steps between a weak
/// drive and the strongest of the scene's own targets, up and down, so that each excites the natural mode.
std::vector<double> targets(const scene::Scene& scene);

/// Of a target step of the scene, on the plant that was found.
struct StepComparison {
  report::StepMetrics designed;      ///< with the controller of the scene as it is
  report::StepMetrics commissioned;  ///< with one that is designed for the plant that was found
};

struct PlantStudy {
  std::string name;  ///< of the scene
  std::vector<Stretch> stretches;
  double full_scale_N = 0.0;  ///< of the readings
  PlantFit fit;
  std::vector<StepComparison> steps;  ///< none where a loop could not be computed
  std::string scene;  ///< as a file, with what was found; empty where it would be refused
};

/// @param experiment  identifiable
/// @param stretches   the first of them undriven
/// @throws loop::ComputationError  as fit_plant()
PlantStudy study(const configure::Experiment& experiment, std::vector<Stretch> stretches,
                 const std::function<void(double)>& progress);

/// report.html, identify.json, fit.csv and commissioned.toml.
output::StudyReport report(const PlantStudy& study);

}  // namespace sonoglide::identify::plant
