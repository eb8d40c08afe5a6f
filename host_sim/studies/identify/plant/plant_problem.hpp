/// The plant of a scene against what a unit recorded, as a problem of least squares.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host_sim/configure/experiment.hpp"
#include "host_sim/scene_file/document.hpp"
#include "host_sim/studies/identify/least_squares.hpp"
#include "host_sim/studies/identify/plant/stretch.hpp"

namespace sonoglide::identify::plant {

/// A number of the plant that is fitted, as its logarithm.
struct Unknown {
  std::string key;  ///< of the scene
  double stated;    ///< by the scene
  double start;     ///< of the search, > 0
  double least;
  double most;
  /// Of a number that may be 0: what its interval is counted in, which is one of itself. Else 0: the interval is
  /// one of the logarithm.
  double unit = 0.0;
};

inline constexpr const char* damping_key = "plant.damping_N_s_per_m";

inline constexpr const char* force_key = "drive.max_force_amplitude_N";

/// Of the same actuator: fitted as the same multiple of what the scene states.
inline constexpr const char* bias_key = "drive.bias_limit_N";

enum class FullForce {
  stated,  ///< by the scene
  fitted,  ///< with the others, where there is no transducer whose force factor is one with it
};

/// Those of a scene with a spring: the spring first, the friction coefficient, the contact stiffness and the
/// transducer's force factor where it has them, the drive's full force, and the damper.
std::vector<Unknown> unknowns_of(const scene::Scene& scene, FullForce force);

/// Parameters: the logarithms of the unknowns, then of each stretch with a drive what its natural mode swings by
/// at its beginning, in phase and in quadrature, over the design's full velocity.
class PlantProblem {
 public:
  /// Of steps after a target: all of them.
  static constexpr std::size_t all_steps = std::numeric_limits<std::size_t>::max() / 2;

  /// @param nominal    of the scene that the recorded controller was designed for
  /// @param stretches  the first of them undriven; outlive this
  PlantProblem(const configure::Experiment& nominal, const std::vector<Stretch>& stretches,
               FullForce force = FullForce::stated);

  const std::vector<Unknown>& unknowns() const { return unknowns_; }
  /// @return the place of the unknown of that key, -1 if there is none
  Eigen::Index index_of(std::string_view key) const;
  /// The scene's values; nothing swings.
  Eigen::VectorXd start() const;

  /// Of an unknown; beyond an end of its range that end, so that a search comes back from there.
  double value(const Eigen::VectorXd& parameters, std::size_t unknown) const;

  /// Over that of the scene; 1 where it is not fitted.
  double full_force(const Eigen::VectorXd& parameters) const;

  /// The scene whose plant has these values; nothing where they are those of none.
  std::optional<scene::Scene> plant(const Eigen::VectorXd& parameters) const;

  /// Measured less modelled readings of all stretches, one after the other, over the sensor's full scale.
  /// @param after  steps that count of each, after those before its target; fewer where it has fewer
  Eigen::VectorXd residuals(const Eigen::VectorXd& parameters, std::size_t after) const;

  /// Where the parameters from one on are best with those before it held, as far as the readings are linear in
  /// them.
  Eigen::VectorXd adjusted(Eigen::VectorXd parameters, Eigen::Index from, std::size_t after) const;

  /// Of the residuals of all steps, to each unknown as its interval is counted, and to what the stretches swing
  /// by.
  Eigen::MatrixXd slopes(const LeastSquaresFit& fit) const;

  /// The best fit near a start.
  LeastSquaresFit fit(const Eigen::VectorXd& start, std::size_t after) const;

  /// What parameters leave of all steps, as if they were fitted.
  LeastSquaresFit at(const Eigen::VectorXd& parameters) const;

  /// A fit of all steps made better where a number may be 0, which its logarithm never comes to: Gauss-Newton
  /// steps in that number itself.
  /// @param from  parameters before it are held
  LeastSquaresFit polished(LeastSquaresFit fit, Eigen::Index from = 0) const;

  /// @param step  as slopes() counts it
  Eigen::VectorXd moved(Eigen::VectorXd parameters, const Eigen::VectorXd& step) const;

  /// What the natural mode turns by in the longest stretch [rad].
  double longest_turn(const Eigen::VectorXd& parameters) const;

  /// Slopes at parameters whose spring is then moved by so much of its logarithm: the mode turns at another speed,
  /// and the slopes to its swings with it.
  Eigen::MatrixXd turned(Eigen::MatrixXd slopes, const Eigen::VectorXd& parameters,
                         double moved) const;

 private:
  /// The part of the residuals that is one stretch's.
  struct Part {
    const Stretch& stretch;
    Eigen::Index swing;  ///< parameter; -1: the stretch is undriven
    Eigen::Index first;
    Eigen::Index steps;
  };
  std::vector<Part> parts(std::size_t after) const;
  double turn_of_a_step(const Eigen::VectorXd& parameters) const;
  Eigen::VectorXd residuals(const std::optional<scene::Scene>& plant,
                            const Eigen::VectorXd& parameters, const Part& part) const;
  /// Of the residuals to the parameters from one on.
  Eigen::MatrixXd jacobian(const Eigen::VectorXd& parameters, const Eigen::VectorXd& residuals,
                           std::size_t after, Eigen::Index from = 0) const;

  const configure::Experiment& nominal_;
  const std::vector<Stretch>& stretches_;
  std::vector<Unknown> unknowns_;
  scene_file::Document document_;  ///< of the nominal scene, with a true value for each unknown
};

}  // namespace sonoglide::identify::plant
