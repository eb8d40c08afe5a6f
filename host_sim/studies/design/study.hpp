/// A design: what the drive must do, how far it gets, and what it hangs on.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host_sim/configure/experiment.hpp"
#include "host_sim/loop/electrical.hpp"
#include "host_sim/loop/steady/requirement.hpp"
#include "host_sim/loop/steady/self_excitation.hpp"
#include "host_sim/scene/scene.hpp"
#include "host_sim/studies/design/natural_mode.hpp"

namespace sonoglide::design {

// What a design asks of the amplifier, where the drive is a transducer.

/// The scene has a transducer, in all of these.

/// k_eff² = Cm/(C0 + Cm), Cm = Nf²/Ks: the part of the energy that takes part in the exchange
/// between voltage and motion.
double coupling_square(const scene::Scene& scene);

/// fs √(1 + Cm/C0), where the transducer conducts least; it conducts most at fs = Plant::natural_Hz().
double parallel_resonance_Hz(const scene::Scene& scene);

/// V̂²|Y|/2, Y the admittance while the mass is held: what the clamped capacitance takes alone.
double clamped_power_VA(const scene::Scene& scene, double voltage_V);

/// L = V̂²/(2 ω |Q|): beside the transducer it takes the reactive power Q of its fundamental away;
/// NaN where that is not capacitive.
double matching_inductance_H(const scene::Scene& scene, const loop::ElectricalFigures& figures);

/// The spring that puts the natural frequency on the carrier, and what a ratio then takes.
struct ResonantSpring {
  double stiffness_N_per_m;  ///< m ω²
  steady::Requirement requirement;
};

ResonantSpring on_resonance(const scene::Scene& scene, const steady::Requirement& requirement);

// How much of a friction ratio hangs on each parameter.

/// One positive number of a scene that its steady ratio depends on.
struct SceneParameter {
  const char* key;  ///< as `--set` takes it
  const char* symbol;
  double& (*in)(scene::Scene& steady_scene);
};

/// Those that the scene has: damping where it is not 0, contact stiffness of an elastic law.
std::vector<SceneParameter> parameters_of(const scene::Scene& steady_scene);

/// Every other parameter and the drive's force stay as they are: feedback that follows the ratio
/// takes the change out again, feedforward does not. NaN where a plant with the changed parameter
/// settles on no orbit.
struct Sensitivity {
  SceneParameter parameter;
  double logarithmic;     ///< d ln rho / d ln p
  double change_by_more;  ///< of the ratio, by 1 % more of the parameter
  double change_by_less;  ///< by 1 % less

  double largest_change() const;  ///< magnitude; NaN where one of the two is
};

/// Of every parameter, by differences of the ratio on the steady orbit.
/// Error: of the derivative 1e-5, of the changes 1e-9.
/// @throws loop::ComputationError  no steady orbit
std::vector<Sensitivity> sensitivities(const scene::Scene& steady_scene);

/// The changes that a Sensitivity holds: relative.
inline constexpr double parameter_change = 0.01;

/// Ratio with the parameter taken times a factor. @throws loop::ComputationError
double ratio_with(scene::Scene steady_scene, const SceneParameter& parameter, double factor);

/// Of the spring, on which resonance hangs.
SceneParameter stiffness();

// What resonance gives and what it costs: the same contact on another spring.

/// Of the tuning Ks/(m w²): 1 at resonance, the mass alone counts towards 0, the spring alone far
/// above 1.
double tuning(const scene::Scene& scene);

/// The scene on the spring that gives it a tuning.
scene::Scene retuned(scene::Scene scene, double tuning);

/// NaN where no steady vibration is found.
struct DetunedPoint {
  double tuning;
  double drive_force_N;        ///< that the ratio takes
  double change_by_stiffness;  ///< of the ratio, largest by 1 % more or less of Ks, under it
  double ratio_at_same_force;  ///< under the force that it takes at the scene's own tuning
};

struct TuningBand {
  double low;
  double high;
};

/// Whether steady sliding at one speed feeds an oscillation, and the drives that quench it.
struct SelfExcitation {
  double sliding_m_per_s = 0.0;
  steady::Fate undriven = steady::Fate::unknown;
  std::vector<steady::DriveWindow> windows;           ///< up to the drive's limit
  std::vector<steady::DriveWindow> averaged_windows;  ///< likewise, by the averaged friction
};

/// Of one ratio at one sliding speed.
struct Detuning {
  double sliding_m_per_s = 0.0;
  double ratio = 0.0;
  std::vector<DetunedPoint> points;  ///< tuning rises
  /// Where the drive has the force; smallest_tuning or largest_tuning where that goes on beyond.
  std::optional<TuningBand> reachable;
  /// About resonance: outside it 1 % of Ks changes the ratio by no more than the scene's settling
  /// band; largest_tuning where springs above resonance all are too sensitive.
  std::optional<TuningBand> sensitive;
  double change_by_stiffness = steady::undefined;  ///< as a point's, at the scene's own tuning
  double force_at_sensitive_low_N =
      steady::undefined;  ///< the least force below resonance outside that band
};

inline constexpr double smallest_tuning = 0.01;  ///< without a spring mean friction has no hold
inline constexpr double largest_tuning = 50.0;   ///< no square number: harmonics meet no resonance

/// @param requirement  of the scene at its own tuning, with a motion
Detuning detune(const scene::Scene& scene, const steady::Requirement& requirement);

// What a design is asked for.

/// The least friction ratio that is designed for.
inline constexpr double least_ratio = 1e-3;

struct SpeedRange {
  double slowest_m_per_s;  ///< > 0
  double fastest_m_per_s;
};

/// Whether a ratio, or speeds, can be named in place of the scene's.
bool is_allowed(double ratio);
bool is_allowed(const SpeedRange& speeds);
/// Which can, in words.
std::string allowed_ratios();
std::string allowed_speeds();

struct Task {
  scene::Scene scene;   ///< closed loop: plant, contact and drive with its limit
  scene::Scene stated;  ///< the same without true values
  /// Of its controller: slower, the drive is held.
  double speed_floor_m_per_s;
  /// Of its velocities: from here on the drive is held and then taken to zero.
  double full_scale_m_per_s;
  std::vector<double> ratios;  ///< each once, rising
  SpeedRange speeds;
  bool at_resonance;  ///< where a controller keeps the drive, by its frequency
};

/// The ratios and the speeds that a closed-loop scene gives, unless others are named. The sign of a
/// speed is of no consequence; what the scene slides slower than the controller's speed floor, down
/// to a stop, is left out.
///
/// @param ratios  in (0, 1); empty: the scene's targets
/// @throws configure::ConfigurationError  no controller, no ratio from least_ratio to below 1, or a contact without a steady orbit of the
///         drive's period or without a closed form: sign_convention "as_printed", another waveform
///         than the cosine
Task make_task(const configure::Experiment& experiment, const std::vector<double>& ratios,
               const std::optional<SpeedRange>& speeds);

using Progress = std::function<void(double fraction)>;

/// A ratio at an end of the task's speeds.
struct DesignPoint {
  steady::Requirement requirement;
  std::vector<Sensitivity> sensitivities;  ///< empty without a motion
};

/// One friction ratio over all speeds.
struct RatioRequirements {
  double ratio;
  std::vector<steady::Requirement> requirements;  ///< by rising speed: study().speeds_m_per_s
  double fastest_m_per_s;  ///< at which drive and controller hold the ratio; may be NaN
};

struct DesignStudy {
  Task task;
  double tuning;  ///< Ks/(m w²)
  std::vector<RatioRequirements> curves;
  std::vector<DesignPoint> points;  ///< slowest speed first, ratios rising; one speed is once
  std::vector<Detuning> detunings;  ///< each ratio at the fastest speed, where it has a motion
  /// With a transducer: of the point that takes the most power from the amplifier.
  std::optional<ResonantSpring> resonant_spring;
  /// With the ratios that are within reach at the fastest speed; none without one.
  std::optional<NaturalModeStudy> natural_mode;
  /// Of friction that falls with the velocity: at the slowest and the fastest speed.
  std::vector<SelfExcitation> self_excitation;
};

/// The point that takes the most apparent power from the amplifier; null without a transducer, and
/// without a motion.
const steady::Requirement* most_electrical(const DesignStudy& study);

/// The design points that have a motion.
std::vector<DesignPoint> moving_points(const DesignStudy& study);

/// On every core. Of a single speed the curves go from a tenth to ten times it.
/// @throws loop::ComputationError  under no force that was tried there is an orbit
DesignStudy study(const Task& task, const Progress& progress);

}  // namespace sonoglide::design
