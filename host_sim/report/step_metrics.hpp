/// How well a closed loop followed each step of its target.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "firmware/control/interface/drive_command.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/loop/watch.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::report {

/// In which a target, and what is held, are told.
struct TargetUnit {
  const char* name;    ///< "N", of a friction ratio ""
  const char* suffix;  ///< of a key: "_N", of a friction ratio ""
  double size;         ///< of 1: the friction limit at 0 s [N]; of a friction ratio 1

  bool is_force() const { return *name != '\0'; }
  /// What is held in a carrier period, in multiples of the size.
  double held(const loop::Period& period) const {
    return is_force() ? period.friction_force_N / size : period.friction_ratio;
  }
};
TargetUnit target_unit(const scene::Scene& scene);

// Which target a carrier period belongs to.

/// The part of a run that belongs to one target.
struct TargetSpan {
  double step_s;     ///< when the target is set
  double begin_s;    ///< the later of that and the end of calibration
  double quarter_s;  ///< where the last quarter begins
  double end_s;
  double target;    ///< as StepMetrics has it
  double previous;  ///< target, or undriven ratio, before
};

/// The spans of every target step that begins before the run ends, known before it begins.
std::vector<TargetSpan> target_spans(const scene::Scene& scene);

/// Goes along the spans with the carrier periods of a run.
class SpanCursor {
 public:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  explicit SpanCursor(const scene::Scene& scene);

  const std::vector<TargetSpan>& spans() const { return spans_; }

  /// Index of the span that holds the period from end to end; none where there is none, or where
  /// the run cuts the period short: a mean over part of one is no friction ratio.
  /// @param period  not before the one of the last call
  std::size_t span_of(const loop::Period& period);

  /// Whether the period lies in the last quarter of a span that holds it.
  bool in_last_quarter(const loop::Period& period, const TargetSpan& span) const;

 private:
  std::vector<TargetSpan> spans_;
  double rounding_s_;
  std::size_t current_ = 0;
};

/// How a loop that observes the vibration held it in a target step. A figure for which there is no
/// carrier period is NaN.
struct VibrationMetrics {
  double velocity_m_per_s = 0.0;  ///< mean amplitude of the steady part
  /// From where settling counts until the amplitude is within 2 % of the wanted one for the rest of
  /// the step, a tenth of it at least; absent if it never is.
  std::optional<double> settling_time_s;
};

/// How a resonant loop followed the resonance in the same step.
struct ResonanceMetrics {
  double frequency_Hz = 0.0;     ///< mean of the steady part
  double frequency_error = 0.0;  ///< largest of it, relative to the natural frequency
};

/// The least friction that a contact has, of all vibrations.
struct LeastFriction {
  double ratio;
  double vibration_m_per_s;  ///< peak, by the closed form of the law
  bool below_target;         ///< false: no vibration brings the ratio down to its target
};

/// What the friction ratio does while the controller learns the friction with the drive off.
struct CalibrationMetrics {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();
};

/// One target step, or what calibration leaves of it. "Steady" means the last quarter. A figure for
/// which there is no carrier period is NaN. Pauses in which the controller learns the friction force
/// anew are left out; what they cost is in PauseMetrics.
///
/// Of a target force, target, band and all errors are over the friction limit at 0 s (TargetUnit).
struct StepMetrics {
  double time_s = 0.0;
  double target = 0.0;
  /// From the later of the step's time and the end of calibration until the per-period ratio is
  /// inside target ± band for the rest of the step, which is a tenth of it at least; absent if it
  /// never is. A ratio that enters the band later may be in the middle of a swing.
  std::optional<double> settling_time_s;
  double overshoot =
      0.0;  ///< farthest beyond the target, seen from where the ratio came from; >= 0
  double steady_error = 0.0;       ///< mean ratio − target
  double ripple = 0.0;             ///< half peak-to-peak of the per-period ratio
  double drive_amplitude_N = 0.0;  ///< mean
  /// The most frequent one of the steady part. Where the controller names none though the ratio
  /// never settles, and no fault has switched the drive off, the simulation names what only it can
  /// see: mismatch where the controller takes its reading for settled, else not_settling. It also
  /// names contact_lost, before any other, where a contact that vibrates normally opens in the steady
  /// part; self_excited in place of not_settling, mismatch and ratio_end, where the steady motion under
  /// the mean drive repels; and current where nothing else is named and the true current passes its
  /// limit in the step.
  control::Limit limit = control::Limit::none;
  bool limit_seen_by_controller = true;
  /// Of a limit that the simulation names: the controller senses the force and has not yet found out
  /// whether its reading settles.
  bool controller_undecided = false;
  /// Of not_settling, as far as it is known; pending where it is not, and of every other limit. Where
  /// the simulation names the limit, the steady part is ringing if it leaves the band to both sides,
  /// else offset if its mean is outside.
  control::Settling cause = control::Settling::pending;
  /// Of a step that never settles, whose ratio stays above its target though no more drive lowers it: no
  /// vibration does, or the drive has passed the one that gives the least friction. The limit is then that
  /// of the drive.
  std::optional<LeastFriction> least_friction;
  /// Mean of commanded over target ratio where the controller took the ratio for settled: believed
  /// over true friction force, as it sees it.
  std::optional<double> mismatch;
  std::optional<VibrationMetrics> vibration;  ///< of a loop that observes it
  std::optional<ResonanceMetrics> resonance;  ///< of a resonant loop
};

/// What the pauses cost in which the friction force is learnt anew.
struct PauseMetrics {
  std::uint64_t pauses = 0;
  std::uint64_t periods = 0;   ///< with the drive disturbed
  double time_fraction = 0.0;  ///< of the periods since the first target
  double ratio_cost = 0.0;     ///< mean friction ratio with the pauses minus without
};

/// Measures every target step that begins before the run ends, from its carrier periods as they
/// come.
class StepMeter final : public loop::PeriodSink {
 public:
  /// @param scene   in closed loop
  /// @param design  of its controller
  StepMeter(const scene::Scene& scene, const configure::ControlDesign& design);

  void take(const loop::Period& period) override;

  /// One entry for each step; to be asked after the run.
  std::vector<StepMetrics> steps() const;

  PauseMetrics pauses() const;

  /// Over the second half of the calibration; the range is empty without one.
  const CalibrationMetrics& calibration() const { return calibration_; }

 private:
  struct Tally {
    double settled_s = 0.0;   ///< end of the last period outside the band
    double last_end_s = 0.0;  ///< of the last period
    double overshoot = 0.0;
    std::uint64_t periods = 0;
    // Of the steady part:
    std::uint64_t steady_periods = 0;
    std::uint64_t held_periods = 0;
    double held_sum = 0.0;
    double drive_sum_N = 0.0;
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -std::numeric_limits<double>::infinity();
    std::array<std::uint64_t, control::limit_count> limit_count{};
    std::uint64_t settled_periods = 0;  ///< as the controller sees it
    double mismatch_sum = 0.0;
    control::Settling cause = control::Settling::pending;
    bool fault = false;
    bool open = false;                ///< the contact, at times
    double current_A = 0.0;           ///< largest amplitude of any period, as far as a limit is set
    double velocity_settled_s = 0.0;  ///< end of the last period outside 2 % of the wanted velocity
    bool velocity_wanted = false;
    double velocity_sum_m_per_s = 0.0;
    double frequency_sum_Hz = 0.0;
    double frequency_error = 0.0;
  };

  void take_pause(const loop::Period& period);
  void take_any(const loop::Period& period, const TargetSpan& span, Tally& tally) const;
  void take_steady(const loop::Period& period, Tally& tally) const;
  static bool stays(double since_s, const TargetSpan& span, const Tally& tally);
  bool holds_blindly(const TargetSpan& span, const Tally& tally) const;
  StepMetrics metrics(const TargetSpan& span, const Tally& tally) const;
  void name_unseen_limit(const TargetSpan& span, const Tally& tally, StepMetrics& metrics) const;
  void name_self_excitation(const TargetSpan& span, StepMetrics& metrics) const;
  /// See StepMetrics::least_friction.
  std::optional<LeastFriction> least_friction(const TargetSpan& span,
                                              const StepMetrics& metrics) const;
  void name_least_friction(const TargetSpan& span, StepMetrics& metrics) const;
  void name_passed_bound(const Tally& tally, StepMetrics& metrics) const;
  control::Settling true_cause(const TargetSpan& span, const Tally& tally, bool off) const;
  static VibrationMetrics vibration_metrics(const TargetSpan& span, const Tally& tally);
  static ResonanceMetrics resonance_metrics(const Tally& tally);

  SpanCursor cursor_;
  TargetUnit unit_;
  double band_;
  bool tells_mismatch_;
  bool senses_force_;
  bool observes_vibration_;
  bool resonant_;
  std::optional<scene::Scene> may_excite_itself_;
  std::optional<scene::Scene> has_least_friction_;
  std::optional<double> largest_current_A_;
  double learning_from_s_;
  double learning_until_s_;
  CalibrationMetrics calibration_;
  std::vector<Tally> tallies_;
  bool pausing_ = false;
  std::uint64_t pauses_ = 0;
  std::uint64_t paused_periods_ = 0;
  std::uint64_t periods_ = 0;
  double paused_sum_ = 0.0;  ///< of ratios
  double sum_ = 0.0;
};

/// The steps of a loop, which is run for them alone.
/// @param plant   the scene of the plant, in closed loop
/// @param design  of the controller
/// @throws loop::ComputationError
std::vector<StepMetrics> measured_steps(const scene::Scene& plant,
                                        const configure::ControlDesign& design);

/// Largest |ratio − target| over the carrier periods in which the target can be expected to be met:
/// sliding at or above the speed floor from end to end, and more than ten periods after the target
/// step, the end of calibration or the last period at the actuator's or the slew limit.
class TrackingMeter final : public loop::PeriodSink {
 public:
  /// @param scene  in closed loop
  TrackingMeter(const scene::Scene& scene, double speed_floor_m_per_s);

  void take(const loop::Period& period) override;

  /// Absent where there was no such period.
  std::optional<double> largest_error() const { return largest_; }

 private:
  SpanCursor cursor_;
  TargetUnit unit_;
  double speed_floor_m_per_s_;
  std::size_t span_ = SpanCursor::none;
  int free_periods_ = 0;  ///< since the step, or since something but the speed floor was in the way
  std::optional<double> largest_;
};

}  // namespace sonoglide::report
