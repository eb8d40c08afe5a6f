/// From a scene to the controller's per-unit numbers: the only place where the controller's units
/// become scaled numbers.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "firmware/control/interface/drive_command.hpp"
#include "firmware/numeric/turn.hpp"
#include "host_sim/configure/friction/inverse_design.hpp"
#include "host_sim/configure/friction/vibration_map.hpp"
#include "host_sim/configure/vibration/bias_design.hpp"
#include "host_sim/configure/vibration/damped_design.hpp"
#include "host_sim/configure/vibration/notch_design.hpp"
#include "host_sim/configure/vibration/resonant_design.hpp"
#include "host_sim/configure/vibration/sensorless_design.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::configure {

/// The numbers of a target that runs along the sliding distance. The integers are those of app::TexturePath and
/// of the steps that advance it.
struct TextureDesign {
  std::vector<double> values;  ///< friction ratios, or forces [N]
  std::int64_t period = 0;
  std::uint32_t inverse = 0;
  std::uint32_t lead = 0;
  std::uint32_t weight = 0;

  /// Steepest change of the vibration at the fastest sliding, over what the drive can: above 1 it is not
  /// followed there. 0 where nothing limits it.
  double overload = 0.0;
  /// Strongest vibration of the texture there, over what a resonant drive holds; 0 of another drive.
  double vibration_demand = 0.0;
  double fastest_m_per_s = 0.0;                 ///< sliding
  control::Limit limit = control::Limit::none;  ///< that is named where it is not followed
};

/// What the controller's per-unit numbers are multiples of.
struct ControlScales {
  double carrier_period_s;
  double force_N;  ///< the sensor's full scale
  /// Nominal peak vibration velocity at full drive; where the vibration is observed, the range of
  /// its sensor; in the sensorless mode sensorless_room times as much.
  double velocity_m_per_s;
  double drive_amplitude_N;  ///< the actuator's limit
  int every_periods = 1;     ///< carrier periods in a step

  /// Of the controller, whose counts of periods, gains and weights are those of its steps.
  double step_period_s() const { return every_periods * carrier_period_s; }
};

/// drive.delay_periods at its longest.
inline constexpr int max_drive_delay = 16;
/// The same with sensor.delay_periods at its longest: from a period to the answer to its reading.
inline constexpr int max_reading_delay = max_drive_delay + 64;
/// The longest delay of a target to its reading: drive and sensor at their longest, and the notch.
inline constexpr int max_reference_delay = 1 + 16 + 64 + max_notch_span / 2;

/// How the gain of the feedback follows the swings of the friction ratio (control::AdaptiveRegulator).
struct AdaptiveGain {
  double least_part = 1.0;   ///< of the integral's gain
  double shrink = 0.5;       ///< by each swing
  double growth = 0.0;       ///< by each period of a lasting error
  double small_error = 0.0;  ///< that does not count, on base 2
  std::uint16_t patience_periods = 0;
};

/// Of a slow contact behind a drive that is fed forward (control::ContactForesight).
struct ContactForesight {
  double presliding_periods =
      0.0;  ///< in which the sliding takes the contact through its presliding distance
  double least_ratio = 0.0;  ///< that the contact follows at full drive
};

/// A controller's parameters as real numbers, per unit of ControlScales; friction ratios on base 2. A
/// "period" in a name here is one of the controller, controller.every_periods carrier periods.
struct ControlDesign {
  ControlScales scales{};
  scene::FrictionMap map = scene::FrictionMap::dahl;  ///< of the feedforward
  std::optional<InverseDesign> inverse;               ///< a tabulated one
  std::optional<double> unreachable_ratio;            ///< the lowest target that no vibration gives
  double friction_force = 0.0;                        ///< nominal Fc
  double smallest_friction = 0.0;                     ///< that may be learnt
  double contact_force = 0.0;  ///< nominal Kt times the vibration amplitude at full drive
  double speed_floor = 0.0;
  double lead_periods = 0.0;   ///< from a sample to the middle of its effect
  double integral_gain = 0.0;  ///< per period
  std::optional<AdaptiveGain> adaptive_gain;
  double contact_lead = 0.0;  ///< see control::ContactLead; 0: the contact is prompt
  std::optional<ContactForesight> contact_foresight;
  double reference_keep = 0.0;  ///< of the reference's lag behind a past target, per period
  std::uint8_t reference_delay_periods = 1;
  std::uint16_t hold_periods = 0;
  std::uint16_t rest_periods = 0;   ///< between two holds for a changed target
  std::uint16_t stuck_periods = 0;  ///< 0: not supervised
  std::uint16_t implausible_periods = 0;
  std::uint32_t standstill_hold_periods = 0;
  double standstill_fall = 0.0;  ///< of the amplitude after that, per period
  double settling_band = 0.0;    ///< as the sensor shows it, on base 2
  std::uint16_t settling_patience_periods = 0;
  /// The feedforward's map is the law's own, and friction too light to slow the largest vibration.
  bool maps_friction = false;
  /// Nor that of any target: commanded over target ratio tells nominal over true friction.
  bool estimates_mismatch = false;
  double agreement = 0.0;  ///< 1 / controller.mismatch_warning; 0: the loop tells of no mismatch

  double carrier_Hz = 0.0;            ///< nominal, at the start
  double force_factor_N_per_V = 0.0;  ///< nominal, over which a motional current is a velocity
  bool senses_force = true;
  bool holds_force = false;              ///< a friction force is the target, not a ratio
  std::optional<TextureDesign> texture;  ///< a target along the sliding distance, in place of steps
  /// In the order of scene::VibrationMode.
  std::variant<FeedforwardDesign, SensorlessDesign, DampedDesign, ResonantDesign> vibration;
  std::optional<BiasDesign> bias;    ///< where the scene has a bias limit
  double usual_calibration_s = 0.0;  ///< in which contact and sensor settle

  bool slew_limited = false;  ///< the members below hold where the flag is set
  double slew_per_period = 0.0;
  bool calibrated = false;
  std::uint32_t calibration_settle_periods = 0;
  std::uint32_t calibration_average_periods = 0;
  std::uint32_t calibration_total_periods = 0;
  bool calibration_outlasts_target = false;  ///< the first one, which then is not followed
  double calibration_weight = 0.0;           ///< of a sample averaged
  double calibration_half_steady = 1.0;      ///< half the largest difference of samples at rest
  bool tracks = false;                       ///< the friction, while driving
  std::uint16_t tracking_wait_periods = 0;
  std::uint8_t tracking_average_periods = 0;
  std::uint16_t tracking_dip_periods = 0;
  double tracking_unsettled = 0.0;     ///< part of a change that the contact has not settled from
  double tracking_weight = 0.0;        ///< of a sample averaged
  double tracking_deviation = 0.0;     ///< of a mean force, over Fc
  double tracking_noise = 0.0;         ///< the part of it that is another in each reading
  double tracking_scatter = 0.0;       ///< the most by which noise raises a period's force, over Fc
  bool tracking_shows_ringing = true;  ///< the natural mode turns at least once in a reading
  double tracking_certain = 0.0;       ///< deviation of ln Fc up to which the drive does not dip
  double tracking_edge = 0.0;   ///< drive of a dip, over the nominal one at which sliding stops
  double gain_deviation = 0.0;  ///< of ln g, true over nominal vibration velocity, at the start
  bool relearns = false;
  std::uint32_t relearn_every_periods = 0;
  std::uint16_t relearn_quiet_periods = 0;
  double relearn_travel = 0.0;  ///< in 64 periods at full drive's peak vibration velocity
  std::uint16_t relearn_reading_periods = 0;
  std::uint16_t relearn_return_periods = 0;
  std::uint8_t relearn_average_periods = 0;
  double relearn_weight = 0.0;  ///< of a sample averaged

  /// The nominal one.
  double contact_stiffness_N_per_m() const {
    return contact_force * scales.force_N * numeric::two_pi /
           (scales.velocity_m_per_s * scales.carrier_period_s);
  }
  double speed_floor_m_per_s() const { return speed_floor * scales.velocity_m_per_s; }
  scene::VibrationMode vibration_mode() const {
    return static_cast<scene::VibrationMode>(vibration.index());
  }
  /// That of one mode; null in another.
  template <class Mode>
  const Mode* in_mode() const {
    return std::get_if<Mode>(&vibration);
  }
  const ResonantDesign* resonance() const { return in_mode<ResonantDesign>(); }
  /// Of a drive that is fed forward, where it has one.
  const NotchDesign* notch() const {
    const auto* fed_forward = in_mode<FeedforwardDesign>();
    return fed_forward != nullptr && fed_forward->notch ? &*fed_forward->notch : nullptr;
  }
  /// Periods from the first tap of the notch to its last.
  int notch_span() const { return notch() != nullptr ? notch()->span() : 0; }
  /// Until a change of the request has become one of the vibration.
  double changing_periods() const {
    return std::visit([](const auto& mode) { return mode.changing_periods(); }, vibration);
  }
  VibrationMap vibration_map(double nominal_friction_N) const {
    return {map, scales.velocity_m_per_s, contact_force * scales.force_N / nominal_friction_N,
            inverse ? &*inverse : nullptr, nominal_friction_N / (friction_force * scales.force_N)};
  }
};

/// Designs the controller of a closed-loop scene from what it believes (the scene through
/// [model_error]; its true values play no part).
/// @throws ConfigurationError where no controller exists: resonance with next to no damping, speeds
///         or forces outside the per-unit range.
ControlDesign design_control(const scene::Scene& scene);

/// Shortest time in which the friction force can be learnt before the first drive, with noise and,
/// if half of the first target's time allows it, with a contact half as stiff as the nominal one; 0
/// where that half is too short, or no sliding goes on for long enough in it. A default of
/// controller.calibration_s.
/// @param design  of the scene, however it is calibrated
double shortest_calibration_s(const scene::Scene& scene, const ControlDesign& design);

/// What one should know of a design before it runs, a sentence each.
std::vector<std::string> design_notes(const ControlDesign& design);

}  // namespace sonoglide::configure
