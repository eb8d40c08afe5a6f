#include "host_sim/configure/design_steps.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/turn.hpp"
#include "host_sim/configure/design_periods.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/configure/vibration/ramp_design.hpp"
#include "host_sim/scene/friction_laws.hpp"

namespace sonoglide::configure {
namespace {

/// Of a drive whose amplitude jumps.
FeedforwardDesign design_stepped(const scene::Scene& scene, const NaturalMode& mode) {
  FeedforwardDesign found;
  design_named_notch(scene, mode, found);
  found.quieting = found.notch ? Quieting::notch : Quieting::nothing;
  return found;
}

/// A natural mode that nothing notches out answers every change of the command, and feedback excites
/// it. It stays stable while the gain removes less damping than the mode has. Without damping there
/// is no such gain, and feedforward is left alone. A scene that leaves the notch out on purpose gets
/// slow feedback all the same, to show what becomes of it.
double gain_beside_free_mode(const scene::Scene& scene, const NaturalMode& mode) {
  constexpr double slow = 0.005;
  constexpr double part_of_decay = 0.2;
  return scene.controller->shaping == scene::Shaping::none
             ? slow
             : std::min(slow, part_of_decay * (1.0 - mode.decay));
}

/// Feedback drives what a notch or a ramp leaves of the free mode, to grow or to decay as the delays
/// of the loop have it, and at a rate below a part of gain times ripple per period. Behind a
/// notch an eighth was seen, at Table 1 and the worst of several delays; under a ramp alone up to 0.6,
/// with a mode at 2.06 carriers.
double missing_damping_N_s_per_m(double ripple, bool ramp_alone, const NaturalMode& mode,
                                 double mass_kg, const ControlDesign& design) {
  const double growth = (ramp_alone ? 0.625 : 0.25) * design.integral_gain * ripple;
  return growth > 1.0 - mode.decay ? 2.0 * mass_kg * growth / design.scales.step_period_s() : 0.0;
}

/// An integrator behind a delay of D periods oscillates at a gain of 2 sin(π/(4D+2)); a third of it
/// leaves room for a contact twice as steep as the nominal one.
double gain_behind_delay(double periods) {
  return std::min(0.25, 2.0 / 3.0 * numeric::sin(numeric::two_pi / (8.0 * periods + 4.0)));
}

/// Harmonics of the friction drive a natural mode beside a multiple of the carrier, which keeps what it is
/// given unless its damping takes it.
bool keeps_harmonics(const scene::Scene& scene, const NaturalMode& mode) {
  constexpr double beside = 0.1;  // carrier frequencies
  constexpr double damped = 0.2;  // part of its free vibration that the mode loses in a step
  const double per_carrier = mode.rotation / numeric::two_pi / scene.controller->every_periods;
  const double multiple = std::round(per_carrier);
  return multiple >= 2.0 && std::abs(per_carrier - multiple) < beside && 1.0 - mode.decay < damped;
}

/// A limit cycle behind a delay of D periods keeps the sign of its error for 2 D + 1 of them; twice that, and two
/// more, is an error that lasts.
AdaptiveGain gain_that_adapts(const scene::Scene& scene, double delay) {
  constexpr double part_of_band = 0.125;
  AdaptiveGain found;
  found.least_part = 0.05;
  found.shrink = 0.7;
  found.growth = 0.1;
  found.small_error = 0.5 * part_of_band * scene.run.settling_band;
  found.patience_periods = whole_periods(4.0 * (delay + 1.0));
  return found;
}

/// How long the integral waits for a changed target, and then does not.
/// @param lag  that the reading follows by, in periods
void set_waiting(const scene::Scene& scene, double delay, double lag, ControlDesign& design) {
  constexpr double lag_settling = 4.0;    // time constants more: 2 % of a step is left
  constexpr double rest_per_hold = 1.25;  // in which feedback acts
  const double contact_settling = contact_settling_periods(scene);
  design.hold_periods = whole_periods(delay + contact_settling + lag_settling * lag);
  design.rest_periods = whole_periods(rest_per_hold * design.hold_periods);
}

/// The ratio of a contact that is read, and that shows the vibration, may follow the drive slowly.
bool may_be_slow(const scene::Scene& scene) {
  return scene.sensor.force && scene::is_elastic(scene.friction.law) &&
         scene::vibrates_along(scene.friction.law);
}

/// The lead of a slow contact (control::ContactLead), where the vibration is observed: of a drive that is fed forward
/// it would excite a mode whose stiffness is off. None where it would add less than a quarter of the error at a ratio
/// of 1, nor at resonance, where the vibration itself takes longer than the contact.
/// @pre the gain of the integral is designed
/// @return the longest time constant with which the error then decays, in periods; 0 without a lead
double design_contact_lead(const scene::Scene& scene, const NominalPlant& plant,
                           ControlDesign& design) {
  constexpr double least = 0.25;
  constexpr double most = 1024.0;  // beyond it an error of 0.001 asks for all of the drive
  const double slid_m = scene.sliding.fastest_m_per_s() * design.scales.step_period_s();
  if (!may_be_slow(scene) || scene.vibration_mode() == scene::VibrationMode::resonant ||
      !(slid_m > 0.0)) {
    return 0.0;
  }
  const double lead = design.integral_gain * presliding_m(plant) / slid_m;
  if (!(lead > least)) {
    return 0.0;
  }
  design.contact_lead = std::min(most, lead);
  return 1.0 / design.integral_gain;
}

/// A command that overshoots and comes back passes a notch whole only if no tap is below 0: such a tap takes away what
/// another gave a moment before, and the drive ends at 0.
bool passes_an_overshoot(const std::optional<NotchDesign>& notch) {
  return !notch ||
         std::all_of(notch->taps.begin(), notch->taps.end(), [](double tap) { return tap >= 0.0; });
}

/// Mean velocity over mean speed at full drive: what a contact follows that forgets little in a period.
double least_ratio(double sliding_m_per_s, double full_m_per_s) {
  const double ratio = sliding_m_per_s / full_m_per_s;
  if (!(ratio < 1.0)) {
    return 1.0;
  }
  return 0.25 * numeric::two_pi * ratio /
         (ratio * numeric::asin(ratio) + numeric::sqrt(1.0 - ratio * ratio));
}

/// The foresight of a slow contact, where the vibration is not observed; where the friction would take longer than
/// the four periods in which the model comes to its target. None where every change of the drive excites the mode,
/// nor for a force, whose readings tell the ratio only at the target.
std::optional<ContactForesight> design_contact_foresight(const scene::Scene& scene,
                                                         const NominalPlant& plant,
                                                         const ControlDesign& design,
                                                         const FeedforwardDesign& fed_forward) {
  constexpr double least_periods = 4.0;
  constexpr double most_periods = 1024.0;
  constexpr double useful_ratio = 0.125;  // a command below it is not needed
  constexpr double most_left = 0.05;      // of the free vibration, by an overshoot to full drive
  if (!may_be_slow(scene) || design.holds_force || fed_forward.left > most_left ||
      fed_forward.free_mode || !passes_an_overshoot(fed_forward.notch)) {
    return std::nullopt;
  }
  const double sliding_m_per_s = scene.sliding.fastest_m_per_s();
  const double slid_m = sliding_m_per_s * design.scales.step_period_s();
  const double periods = slid_m > 0.0 ? presliding_m(plant) / slid_m : 0.0;
  if (!(periods > least_periods)) {
    return std::nullopt;
  }
  return ContactForesight{
      std::min(most_periods, periods),
      std::max(useful_ratio, least_ratio(sliding_m_per_s, design.scales.velocity_m_per_s))};
}

}  // namespace

void design_named_notch(const scene::Scene& scene, const NaturalMode& mode,
                        FeedforwardDesign& found) {
  const scene::Controller& controller = *scene.controller;
  switch (controller.shaping.value_or(scene::Shaping::notch)) {
    case scene::Shaping::none:
      return;
    case scene::Shaping::notch:
      found.notch = design_notch(mode);
      return;
    case scene::Shaping::robust:
      break;
  }
  const std::optional<double> range = controller.shaping_range
                                          ? controller.shaping_range
                                          : tolerated_shaping_range(scene.tolerances);
  if (range) {
    found.shaping_range = *range;
    found.notch = design_robust_notch(mode, *range);
    return;
  }
  found.notch = design_widest_notch(mode);
  found.shaping_range = found.notch ? found.notch->range : 0.0;
  if (!found.notch) {
    found.notch = design_notch(mode);
    found.not_robust = found.notch.has_value();
  }
}

FeedforwardDesign design_feedforward(const scene::Scene& scene, const NominalPlant& plant,
                                     ControlDesign& design) {
  const NaturalMode mode = natural_mode(plant, design.scales.step_period_s());
  FeedforwardDesign found = scene.drive->interpolation == scene::Interpolation::linear
                                ? design_ramped(scene, plant, design)
                                : design_stepped(scene, mode);
  const bool quiet =
      found.notch || (found.quieting == Quieting::ramp && !scene.controller->shaping);
  // What the friction changes by is balanced, so that feedback hardly excites it.
  found.free_mode = mode.rotation > 0.0 && !quiet && !(scene.drive->bias_limit_N > 0.0);
  const double filter = filter_periods(scene, design.scales);
  const double shaping = found.changing_periods();
  // From a command to the reading that shows it.
  const double latency = latency_periods(scene);
  const double delay = latency + shaping + filter;
  const double behind_delay = gain_behind_delay(delay);
  design.integral_gain =
      found.free_mode ? std::min(behind_delay, gain_beside_free_mode(scene, mode)) : behind_delay;
  if (found.ramped() && keeps_harmonics(scene, mode)) {
    design.adaptive_gain = gain_that_adapts(scene, delay);
  }
  design.contact_foresight = design_contact_foresight(scene, plant, design, found);
  const double ripple = found.notch ? found.notch->ripple : 0.0;
  found.missing_damping_N_s_per_m =
      missing_damping_N_s_per_m(found.ramped() && quiet ? found.left : ripple,
                                !found.notch.has_value(), mode, plant.mass_kg, design);
  set_waiting(scene, delay, filter, design);
  design.reference_delay_periods = static_cast<std::uint8_t>(latency + 0.5 * shaping);
  design.reference_keep = filter / (1.0 + filter);
  const double drive_delay = scene.drive->delay_periods;
  design.lead_periods = 0.5 + 0.5 * shaping + drive_delay / design.scales.every_periods;
  return found;
}

void design_outer_regulator(const scene::Scene& scene, const NominalPlant& plant,
                            double following_periods, ControlDesign& design) {
  const double filter = filter_periods(scene, design.scales);
  const double latency = latency_periods(scene);
  const double delay = latency + following_periods;
  design.integral_gain = gain_behind_delay(delay + filter);
  const double lag = filter + design_contact_lead(scene, plant, design);
  set_waiting(scene, delay, lag, design);
  design.reference_delay_periods = static_cast<std::uint8_t>(latency);
  design.reference_keep = (lag + 1.0) / (lag + 2.0);
  design.lead_periods = 1.5 + scene.drive->delay_periods;
}

void design_slew(const scene::Drive& drive, ControlDesign& design) {
  if (!drive.max_force_slew_N_per_s) {
    return;
  }
  const NotchDesign* notch = design.notch();
  double gain = notch != nullptr ? 0.0 : 1.0;
  if (notch != nullptr) {
    for (const double tap : notch->taps) {
      gain += std::abs(tap);
    }
  }
  // The amplitude of a step passes in one carrier period.
  const double per_period = *drive.max_force_slew_N_per_s * design.scales.carrier_period_s /
                            design.scales.drive_amplitude_N;
  design.slew_limited = per_period < gain;
  design.slew_per_period = per_period / gain;
}

}  // namespace sonoglide::configure
