/// What becomes of the natural mode when the drive changes: what keeps it quiet, and at which carriers.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "host_sim/configure/vibration/ramp_design.hpp"
#include "host_sim/configure/vibration/recommended_means.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::design {

/// Plants tried with the same targets, by how their worst target step went.
struct Tally {
  std::size_t settled = 0;  ///< within prompt_periods
  std::size_t late = 0;
  std::size_t never = 0;
};

/// A controller that feeds the drive forward, with one way of the amplitude from period to period.
struct QuietDrive {
  scene::Interpolation interpolation = scene::Interpolation::step;
  configure::Quieting quieting = configure::Quieting::nothing;
  std::size_t tap_count = 0;
  double changing_periods = 0.0;    ///< until a change of the drive is complete
  configure::LeftBehind left = {};  ///< of the natural mode, at the worst within the range
  Tally plants = {};                ///< at the scene's carrier
};

struct CarrierPoint {
  double frequency_Hz = 0.0;
  double mode_per_carrier = 0.0;
  double from_multiple =
      0.0;                ///< to the nearest whole multiple of the carrier, 0 included; in carriers
  bool reachable = true;  ///< there is a controller, and the drive has the force
  Tally plants = {};
};

/// A loop with a bias against a slow mode, seen by a velocity sensor.
struct BiasedDrive {
  double limit_N = 0.0;  ///< with which the bias is seldom at its end
  Tally plants = {};     ///< at the scene's carrier
};

/// A line of a scene's table.
struct SceneLine {
  std::string table;
  std::string key;
  std::string value;  ///< as TOML has it
};

/// The loop that reaches the most with the force sensor alone, by the nominal mode.
struct RecommendedLoop {
  configure::RecommendedMeans means;
  scene::FrictionSource friction =
      scene::FrictionSource::trusted;  ///< that the first target leaves time for
  double bias_limit_N = 0.0;           ///< with a bias
  Tally plants = {};                   ///< at the scene's carrier, with a friction that is known
  std::string refused;                 ///< why the scene can have no such loop; empty: it can
  std::vector<SceneLine> lines;        ///< of a scene with this loop
  std::vector<std::string>
      leaves;            ///< keys of the scene that contradict it, such as "controller.shaping"
  bool unnamed = false;  ///< the scene has none of the keys of such means
};

struct NaturalModeStudy {
  double natural_Hz = 0.0;
  double range = 0.0;              ///< by which the natural frequency may be off, relative
  double stiffness_range = 0.0;    ///< of the plants tried, relative
  bool assumed_range = false;      ///< the scene tells of none
  bool model_error = false;        ///< of the scene, which the controllers have besides
  std::size_t plants = 0;          ///< with each drive, and at each carrier
  std::size_t targets = 0;         ///< of each loop
  int step_periods = 0;            ///< that each of them lasts
  std::vector<QuietDrive> drives;  ///< step, then linear
  /// Of these the one with which fewest never settle, then fewest late; then the quickest.
  std::size_t best_drive = 0;
  std::vector<CarrierPoint> carriers;      ///< by rising frequency, with the best drive
  std::size_t own = 0;                     ///< the scene's place among them
  std::optional<std::size_t> recommended;  ///< recommended_carrier
  RecommendedLoop recommended_loop;
  std::optional<BiasedDrive>
      bias;  ///< of a mode below slow_mode carriers, under a force of a cosine
};

inline constexpr int prompt_periods = 60;  ///< a millisecond at 60 kHz

/// A change is recommended if at least so many more plants settle with it.
inline constexpr std::size_t worth_a_change = 2;

/// The nearest at which the most plants settle promptly, and the scene's own where no other is worth a change;
/// none if none settles.
std::optional<std::size_t> recommended_carrier(const NaturalModeStudy& study);

/// The other carrier at which the most plants settle; between equals the nearest. There are at least two.
const CarrierPoint& best_other_carrier(const NaturalModeStudy& study);

/// Of a loop off resonance whose plant has a natural mode; else none. Under a law whose vibration is across the
/// sliding, the swing of the ratio is that of one along it.
/// @param stated  as the controller knows it
/// @param ratios  targets, in (0, 1)
std::optional<NaturalModeStudy> natural_mode_study(const scene::Scene& stated,
                                                   const std::vector<double>& ratios,
                                                   double sliding_m_per_s);

}  // namespace sonoglide::design
