/// A validated scene: plain values in SI units, the unit in the name, every default filled in.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host_sim/scene/contact.hpp"
#include "host_sim/scene/friction_laws.hpp"
#include "host_sim/scene/timed_profile.hpp"
#include "host_sim/scene/tolerance.hpp"

namespace sonoglide::scene {

/// The nearest multiple of a step; without a step (0) the value itself.
inline double nearest_multiple(double value, double step) {
  return step > 0.0 ? step * std::round(value / step) : value;
}

/// √(Ks/m)/2π, without damping; 0 without a spring.
double natural_Hz(double stiffness_N_per_m, double mass_kg);

/// Where the profile holds anything, the stiffness is its value at 0 s.
struct Plant {
  double mass_kg = 0.0;
  double stiffness_N_per_m = 0.0;
  TimedProfile stiffness_profile;
  double damping_N_s_per_m = 0.0;
  double initial_displacement_m = 0.0;
  double initial_velocity_m_per_s = 0.0;

  /// √(Ks/m), without damping; 0 without a spring.
  double natural_rad_per_s() const;
  double natural_Hz() const;
  /// Ks, or the largest value of its profile.
  double stiffest_N_per_m() const;
};

/// Where a profile holds anything, the member of Contact that it stands for is its value at 0 s.
struct Friction : ContactValues {
  FrictionLaw law = laws::None{};
  TimedProfile coefficient_profile;
  TimedProfile normal_force_profile_N;

  bool has_profile() const {
    return !coefficient_profile.empty() || !normal_force_profile_N.empty();
  }
  /// The largest coefficient times the largest normal force, of profiles too; where nothing changes
  /// Fc, and 0 without a law.
  double largest_limit_N() const;
};

struct SpeedPoint {
  double time_s = 0.0;
  double velocity_m_per_s = 0.0;
};

/// Sliding velocity, linear between the points and constant outside them; one point is a constant.
struct Sliding {
  std::vector<SpeedPoint> profile;

  /// Largest modulus [m/s].
  double fastest_m_per_s() const;
};

/// A body of its own mass M that slides, in place of a sliding velocity that is given:
///   M dVt/dt = Fa - c Vt - k (x - ∫vp dt) - F,  F the friction.
struct Load {
  double mass_kg = 0.0;
  double damping_N_s_per_m = 0.0;
  double initial_velocity_m_per_s = 0.0;
  TimedProfile force_profile_N;                  ///< Fa; empty: 0
  double spring_N_per_m = 0.0;                   ///< k
  std::vector<SpeedPoint> pull_profile_m_per_s;  ///< vp, of the far end of the spring; empty: 0

  /// What a controller is designed for: of the initial velocity, those of the pulled end, and the one that
  /// the damper allows under the force, the one of the largest modulus.
  double fastest_m_per_s() const;
};

/// Of the force, with its peak A at phase 0: the square is A up to half a period and -A beyond, the
/// triangle falls to -A at half a period and rises again, the sawtooth falls over the whole period.
enum class Waveform { cosine, square, triangle, sawtooth };

/// How the amplitude passes, at a phase 0, from that of one carrier period to that of the next: at
/// once, or linearly over the period that begins there.
enum class Interpolation { step, linear };

/// Piezo force of amplitude A; A is fixed in open loop, the controller's in closed loop. A drive is
/// given by its force or by its voltage into a transducer; Scene::drive_force_N() adds up the two.
struct Drive {
  double frequency_Hz = 0.0;
  TimedProfile frequency_profile;        ///< open loop: the frequency, taken at each phase 0
  double frequency_resolution_Hz = 0.0;  ///< the frequency is a multiple of it; 0: any
  double force_amplitude_N = 0.0;        ///< open loop
  double voltage_amplitude_V = 0.0;      ///< open loop, with a transducer
  double max_force_amplitude_N = 0.0;    ///< closed loop: the actuator's limit
  double max_voltage_amplitude_V = 0.0;  ///< closed loop, with a transducer: the amplifier's limit
  /// Resonant closed loop: of the fundamental; absent, no limit.
  std::optional<double> max_current_amplitude_A;
  std::optional<double> max_force_slew_N_per_s;  ///< closed loop: absent, no slew limit
  Waveform waveform = Waveform::cosine;
  /// Closed loop: from the end of a sampled period to where its answer acts.
  int delay_periods = 1;
  std::optional<int> bits;  ///< closed loop: of the amplitude; absent, as fine as the arithmetic
  Interpolation interpolation = Interpolation::step;  ///< closed loop
  /// Linear: 1, a true ramp; n > 1, a staircase of n equal parts of the period, each with the
  /// amplitude that the ramp has in its middle.
  int codes_per_period = 1;
  /// Closed loop: largest force that is constant over a carrier period; 0: none.
  double bias_limit_N = 0.0;

  /// Within each piece of a carrier period the force is linear in time.
  bool is_straight() const { return waveform != Waveform::cosine; }
  /// Within a carrier period there may be more than a cosine of one amplitude.
  bool is_ramped() const {
    return (interpolation == Interpolation::linear && codes_per_period == 1) || bias_limit_N > 0.0;
  }
  /// Of its profile the largest.
  double highest_frequency_Hz() const;
  /// 2π f, f the frequency.
  double rate_rad_per_s() const;
  /// The nearest multiple of the resolution, at least one; without a resolution the frequency itself.
  double nearest_frequency_Hz(double asked_Hz) const;
};

/// Turns a voltage into a force, and takes a current for it: i = Nf x' + C0 V' + V/R0, with
/// R0 = 1/(ω C0 tan δ).
struct Transducer {
  double force_factor_N_per_V = 0.0;   ///< Nf
  double clamped_capacitance_F = 0.0;  ///< C0
  double loss_tangent = 0.0;           ///< tan δ of C0

  double force_N(double voltage_V) const { return force_factor_N_per_V * voltage_V; }
  double voltage_V(double force_N) const { return force_N / force_factor_N_per_V; }
};

/// A solver by its place in the list of solver_methods.hpp.
struct SolverMethod {
  std::size_t index = 0;
};

constexpr bool operator==(SolverMethod a, SolverMethod b) {
  return a.index == b.index;
}
constexpr bool operator!=(SolverMethod a, SolverMethod b) {
  return !(a == b);
}

struct Solver {
  SolverMethod method;
  double tolerance = 1e-10;  ///< adaptive methods
  std::optional<int> order;  ///< absent, the one that suits the tolerance
  /// Fixed steps, shortened so that a whole number fits a carrier period. Of an adaptive method the
  /// longest; 0 leaves that to the tolerance.
  double step_s = 0.0;
};

enum class Channel {
  displacement,
  velocity,
  friction_force,
  drive_force,
  sliding_velocity,
  load_displacement
};

/// given: the initial state that the scene gives. steady: on the periodic steady orbit.
enum class Start { given, steady };

struct Run {
  Start start = Start::given;
  double duration_s = 0.0;
  double window_start_s = 0.0;
  double settling_band = 0.01;
  std::vector<Channel> record;
  double record_interval_s = 0.0;  ///< 0 where nothing is recorded
};

enum class Arithmetic { float64, float32, q31, q15 };

/// Of Controller::shaping_range.
inline constexpr double least_shaping_range = 1e-4;
inline constexpr double most_shaping_range = 0.5;

/// robust: a notch for a natural frequency that is known within a range.
enum class Shaping { notch, robust, none };

struct TargetStep {
  double time_s = 0.0;
  double value = 0.0;  ///< friction ratio, or force [N]
};

/// A target that repeats itself along the sliding distance: `values` at equal distances over one period,
/// linear between them and from the last to the first.
struct Texture {
  double period_m = 0.0;
  std::vector<double> values;  ///< friction ratios, or forces [N]
  bool of_force = false;

  double at(double distance_m) const;
};

/// How a controller holds the vibration that it observes. resonant: at the plant's resonance, which
/// the frequency of the drive follows. damped: at a fixed frequency, the natural mode damped.
enum class VibrationControl { resonant, damped };

struct FrequencyRange {
  double lowest_Hz = 0.0;
  double highest_Hz = 0.0;
};

/// Where the controller has the friction force from. trusted: from the scene. calibrated: measured
/// before the drive is first used. tracked: learnt while driving.
enum class FrictionSource { trusted, calibrated, tracked };

struct Controller {
  Arithmetic arithmetic = Arithmetic::float64;
  int every_periods = 1;                             ///< carrier periods in a step
  std::optional<VibrationControl> vibration;         ///< absent: fed forward, without observing it
  std::optional<FrequencyRange> frequency_range_Hz;  ///< resonant; absent: the default
  // One of the three:
  std::vector<TargetStep> target_friction_ratio;
  std::vector<TargetStep> target_friction_force_N;
  std::optional<Texture> texture;
  std::optional<FrictionSource> friction;  ///< absent: as calibration_s says
  std::optional<double> calibration_s;     ///< absent: what suits the design, or 0
  /// Absent: of a drive whose amplitude passes linearly, what suits the design.
  std::optional<Shaping> shaping = Shaping::notch;
  std::optional<double> shaping_range;        ///< robust: of the natural frequency, relative
  std::optional<double> speed_floor_m_per_s;  ///< absent: the controller's own default
  double standstill_hold_s = 0.02;            ///< for which the drive is held below the speed floor
  std::optional<double> relearn_every_s;      ///< absent: the friction force is not learnt again
  double mismatch_warning = 1.25;  ///< believed over true friction, or its inverse, that is named

  /// A friction force is the target, not a ratio.
  bool holds_force() const {
    return texture ? texture->of_force : !target_friction_force_N.empty();
  }
  /// Steps of the target in time; none of a texture.
  const std::vector<TargetStep>& targets() const {
    return holds_force() ? target_friction_force_N : target_friction_ratio;
  }
  /// All values that the target has, or goes through from one to the next.
  std::vector<double> target_values() const;
  /// The key that has the target.
  const char* target_key() const;
};

/// What the vibration is seen by: a pick-up of its velocity, or the transducer's current less that
/// of its clamped capacitance.
enum class VibrationSensor { velocity, motional_current };

/// Absent members leave that part of the sensor ideal. Of offsets and gains the controller knows
/// nothing.
struct Sensor {
  bool force = true;  ///< there is a force sensor; false only where the vibration is observed
  std::optional<int> adc_bits;
  double force_full_scale_N = 0.0;  ///< the converter spans ± this
  double force_noise_N = 0.0;       ///< rms, each sample
  std::optional<double> force_bandwidth_Hz;
  std::optional<int> samples_per_period;  ///< of the force; absent: its mean, taken once
  std::optional<double> filter_Hz;        ///< of a low-pass before these samples
  int delay_periods = 0;
  double force_offset_N = 0.0;
  double force_gain = 1.0;  ///< reading over true; -1: wired backwards, 0: dead
  double velocity_offset_m_per_s = 0.0;
  double velocity_gain = 1.0;
  std::optional<int> velocity_bits;  ///< the converter spans ± the base of velocity of the design
  std::uint64_t seed = 1;
  std::optional<VibrationSensor> vibration;
  std::optional<int> vibration_bits;
  double vibration_noise_m_per_s = 0.0;  ///< rms, each sample, in phase and in quadrature alike
  std::optional<double> vibration_full_scale_m_per_s;  ///< absent: what the design takes

  /// Of the one low-pass that the force goes through.
  std::optional<double> low_pass_Hz() const {
    return force_bandwidth_Hz ? force_bandwidth_Hz : filter_Hz;
  }
  /// Of what is read once per carrier period, rms.
  double reading_noise_N() const {
    return force_noise_N / std::sqrt(samples_per_period.value_or(1));
  }
};

/// What the controller believes divided by what is true.
struct ModelError {
  double mass = 1.0;
  double stiffness = 1.0;
  double coefficient = 1.0;
  double contact_stiffness = 1.0;
  double force_factor = 1.0;
  double damping = 1.0;
};

/// How a controller knows of the vibration, and what it does with it.
enum class VibrationMode {
  feedforward,  ///< nothing tells of it; a notch keeps the natural mode quiet
  sensorless,   ///< held off resonance as an observer sees it in the friction force
  damped,       ///< held off resonance by a sensor of its own
  resonant,     ///< held at resonance, likewise
};

struct Scene {
  std::string name;  ///< the file's name without its ending
  Plant plant;
  Friction friction;
  Sliding sliding;           ///< with a load the velocity that a controller is designed for
  std::optional<Load> load;  ///< absent: the sliding velocity is given
  std::optional<Transducer> transducer;  ///< absent: the drive is a force
  std::optional<Drive> drive;
  Solver solver;
  Run run;
  std::optional<Controller> controller;  ///< absent: open loop
  Sensor sensor;
  ModelError model_error;
  std::vector<Tolerance> tolerances;   ///< for `robust`
  std::vector<TrueValue> true_values;  ///< of the plant that is run, where they are others

  /// The key `table.key` of a profile beside that of the sliding; null where there is none.
  const char* profile_key() const;

  /// Amplitude of the drive's force in open loop, whether it is given as a force or as a voltage.
  double drive_force_N() const;
  /// The largest that its actuator gives in closed loop.
  double max_drive_force_N() const;
  /// That a target can have in closed loop: a ratio of 1, or the force that the sensor reads at most.
  double highest_target() const;
  /// Between two amplitudes that it gives; 0: any.
  double amplitude_step_N() const;

  /// Of an open loop `feedforward`.
  VibrationMode vibration_mode() const;

  /// A controller holds the vibration at the plant's resonance, by the frequency of the drive.
  bool resonant() const { return vibration_mode() == VibrationMode::resonant; }

  /// By a profile, in whose place the inputs of a plant alone stand, or as a controller follows the
  /// resonance.
  bool carrier_changes() const {
    return resonant() || (drive && !drive->frequency_profile.empty());
  }

  /// Somebody asks for the vibration's fundamental.
  bool demodulates() const { return transducer || sensor.vibration; }
};

}  // namespace sonoglide::scene
