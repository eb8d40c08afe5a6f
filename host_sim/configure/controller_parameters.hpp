/// A designed controller's parameters in its own scalar: the only place that makes them, for the
/// simulation and for an image alike.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "firmware/control/controller.hpp"
#include "firmware/control/feedback/adaptive_regulator.hpp"
#include "firmware/control/feedback/contact_foresight.hpp"
#include "firmware/control/feedback/contact_lead.hpp"
#include "firmware/control/feedback/integral_regulator.hpp"
#include "firmware/control/feedback/scaling_regulator.hpp"
#include "firmware/control/friction/dahl_feedforward.hpp"
#include "firmware/control/friction/friction_tracking.hpp"
#include "firmware/control/friction/learnt_friction.hpp"
#include "firmware/control/friction/periodic_relearning.hpp"
#include "firmware/control/friction/tabulated_feedforward.hpp"
#include "firmware/control/limits/notch_shaper.hpp"
#include "firmware/control/limits/slew_limit.hpp"
#include "firmware/control/target.hpp"
#include "firmware/numeric/accumulator.hpp"
#include "firmware/numeric/scalar.hpp"
#include "host_sim/configure/part_parameters.hpp"
#include "host_sim/configure/vibration/parameters.hpp"

namespace sonoglide::configure {

template <class Scalar>
typename control::LearntFriction<Scalar>::Parameters parameters(
    const ControlDesign& design, Type<control::LearntFriction<Scalar>> /*part*/) {
  typename control::LearntFriction<Scalar>::Parameters all{};
  all.settle_periods = design.calibration_settle_periods;
  all.average_periods = design.calibration_average_periods;
  all.weight = scaled<numeric::Accumulator<Scalar>>(design.calibration_weight);
  all.total_periods = design.calibration_total_periods;
  all.half_steady = scaled_within<Scalar>(design.calibration_half_steady);
  return all;
}

template <class Scalar>
typename control::DahlFeedforward<Scalar>::Parameters parameters(
    const ControlDesign& design, Type<control::TrackedDahlFeedforward<Scalar>> /*part*/) {
  return {split<Scalar>(design.contact_force)};
}

template <class Scalar>
typename control::DahlFeedforward<Scalar>::Parameters parameters(
    const ControlDesign& design, Type<control::DahlFeedforward<Scalar>> /*part*/) {
  return {split<Scalar>(design.contact_force)};
}

template <class Scalar>
typename control::TabulatedFeedforward<Scalar>::Parameters parameters(
    const ControlDesign& design, Type<control::TabulatedFeedforward<Scalar>> /*part*/) {
  const InverseDesign inverse = design.inverse.value_or(InverseDesign{});
  const double travel = design.scales.velocity_m_per_s / inverse.reference_m_per_s *
                        (inverse.over_force ? design.friction_force : 1.0);
  return {split<Scalar>(travel), split<Scalar>(inverse.reach), inverse.over_force, inverse.form,
          inverse.table};
}

/// Wide open where the design has none.
template <class Scalar>
typename control::SlewLimit<Scalar>::Parameters parameters(
    const ControlDesign& design, Type<control::SlewLimit<Scalar>> /*part*/) {
  return {design.slew_limited ? scaled<Scalar>(design.slew_per_period)
                              : numeric::from_code<Scalar>(INT32_MAX)};
}

/// Binary digits behind the point of a number just below 1.
template <class Scalar>
constexpr int fraction_digits() {
  if constexpr (numeric::is_fixed_point_v<Scalar>) {
    return Scalar::fraction_bits;
  } else {
    return std::numeric_limits<Scalar>::digits;
  }
}

template <class Scalar, int MaxSpacing>
typename control::NotchShaper<Scalar, MaxSpacing, 3>::Parameters parameters(
    const ControlDesign& design, Type<control::NotchShaper<Scalar, MaxSpacing, 3>> /*part*/) {
  const auto& taps = design.notch()->taps;
  return {{scaled<Scalar>(taps[0]), scaled<Scalar>(taps[1]), scaled<Scalar>(taps[2])},
          design.notch()->spacing};
}

template <class Scalar, int MaxSpacing>
typename control::NotchShaper<Scalar, MaxSpacing, 5>::Parameters parameters(
    const ControlDesign& design, Type<control::NotchShaper<Scalar, MaxSpacing, 5>> /*part*/) {
  const auto taps = rounded_taps(*design.notch(), fraction_digits<Scalar>());
  return {{scaled<Scalar>(taps[0]), scaled<Scalar>(taps[1]), scaled<Scalar>(taps[2]),
           scaled<Scalar>(taps[3]), scaled<Scalar>(taps[4])},
          design.notch()->spacing};
}

template <class Scalar, int MaxDelay>
typename control::IntegralRegulator<Scalar, MaxDelay>::Parameters parameters(
    const ControlDesign& design, Type<control::IntegralRegulator<Scalar, MaxDelay>> /*part*/) {
  typename control::IntegralRegulator<Scalar, MaxDelay>::Parameters all{};
  all.gain = scaled<Scalar>(design.integral_gain);
  all.keep = scaled<Scalar>(design.reference_keep);
  all.hold_periods = design.hold_periods;
  all.rest_periods = design.rest_periods;
  all.delay_periods = design.reference_delay_periods;
  return all;
}

template <class Scalar, int MaxDelay>
typename control::ScalingRegulator<Scalar, MaxDelay>::Parameters parameters(
    const ControlDesign& design, Type<control::ScalingRegulator<Scalar, MaxDelay>> /*part*/) {
  return {parameters(design, Type<control::IntegralRegulator<Scalar, MaxDelay>>{}),
          design.resonance()->scales};
}

/// With the gain of an IntegralRegulator throughout where the design has no other.
template <class Scalar, int MaxDelay>
typename control::AdaptiveRegulator<Scalar, MaxDelay>::Parameters parameters(
    const ControlDesign& design, Type<control::AdaptiveRegulator<Scalar, MaxDelay>> /*part*/) {
  const AdaptiveGain adaptive = design.adaptive_gain.value_or(AdaptiveGain{});
  return {parameters(design, Type<control::IntegralRegulator<Scalar, MaxDelay>>{}),
          scaled<Scalar>(adaptive.least_part * design.integral_gain),
          scaled<Scalar>(adaptive.shrink),
          scaled<Scalar>(adaptive.growth),
          scaled<Scalar>(adaptive.small_error),
          adaptive.patience_periods};
}

/// Without a lead where the design has none.
template <class Regulator>
typename control::ContactLead<Regulator>::Parameters parameters(
    const ControlDesign& design, Type<control::ContactLead<Regulator>> /*part*/) {
  return {parameters(design, Type<Regulator>{}),
          split<typename Regulator::Scalar>(2.0 * design.contact_lead)};
}

/// Of a prompt contact where the design has no foresight.
template <class Regulator>
typename control::ContactForesight<Regulator>::Parameters parameters(
    const ControlDesign& design, Type<control::ContactForesight<Regulator>> /*part*/) {
  using Scalar = typename Regulator::Scalar;
  typename control::ContactForesight<Regulator>::Parameters all{};
  all.regulator = parameters(design, Type<Regulator>{});
  if (design.contact_foresight) {
    const auto [periods, least_ratio] = *design.contact_foresight;
    all.rise = scaled<Scalar>(1.0 / periods);
    all.fall = scaled<Scalar>(std::min(0.25, 1.0 / (periods * least_ratio)));
    all.least = scaled<Scalar>(0.5 * least_ratio);
    all.presliding = split<Scalar>(periods / 8.0);
  }
  return all;
}

/// Without any pause where the design has none.
template <class Scalar>
typename control::PeriodicRelearning<Scalar>::Parameters parameters(
    const ControlDesign& design, Type<control::PeriodicRelearning<Scalar>> /*part*/) {
  typename control::PeriodicRelearning<Scalar>::Parameters all{};
  if (!design.relearns) {
    all.every_periods = control::PeriodicRelearning<Scalar>::never;
    all.reading_periods = 1;
    all.average_periods = 1;
    return all;
  }
  all.every_periods = design.relearn_every_periods;
  all.quiet_periods = design.relearn_quiet_periods;
  all.travel = scaled<Scalar>(design.relearn_travel);
  all.reading_periods = design.relearn_reading_periods;
  all.return_periods = design.relearn_return_periods;
  all.average_periods = design.relearn_average_periods;
  all.weight = scaled<numeric::Accumulator<Scalar>>(design.relearn_weight);
  return all;
}

template <class Scalar>
typename control::ForceTarget<Scalar>::Parameters parameters(
    const ControlDesign& design, Type<control::ForceTarget<Scalar>> /*part*/) {
  return {design.holds_force};
}

/// Deviations of ln Fc and of ln Kt at the start.
inline constexpr double tracked_force_deviation = 0.3;
inline constexpr double tracked_stiffness_deviation = 0.5;

template <class Scalar>
typename control::FrictionTracking<Scalar>::Parameters parameters(
    const ControlDesign& design, Type<control::FrictionTracking<Scalar>> /*part*/) {
  const auto variance = [](double deviation) { return scaled<Scalar>(deviation * deviation); };
  typename control::FrictionTracking<Scalar>::Parameters all{};
  all.mean.wait_periods = design.tracking_wait_periods;
  all.mean.average_periods = design.tracking_average_periods;
  all.mean.weight = scaled<numeric::Accumulator<Scalar>>(design.tracking_weight);
  all.constants.deviation = scaled<Scalar>(design.tracking_deviation / 4.0);
  all.constants.noise = scaled<Scalar>(design.tracking_noise / 4.0);
  all.constants.scatter = scaled<Scalar>(design.tracking_scatter / 2.0);
  all.certain = variance(design.tracking_certain);
  all.dip_periods = design.tracking_dip_periods;
  all.edge = scaled_within<Scalar>(design.tracking_edge);
  all.constants.start.force = variance(tracked_force_deviation);
  all.constants.start.stiffness = variance(tracked_stiffness_deviation);
  all.constants.start.gain = variance(design.gain_deviation);
  return all;
}

/// @tparam Parts  control::Parts: those that the design needs, or such as do their work
template <class Parts>
control::ControllerParameters<Parts> controller_parameters(const ControlDesign& design) {
  using Scalar = typename Parts::Scalar;
  control::ControllerParameters<Parts> all{};
  all.friction_force = scaled<Scalar>(design.friction_force);
  all.smallest_friction = scaled<Scalar>(design.smallest_friction);
  all.speed_floor = scaled<Scalar>(design.speed_floor);
  all.lead = scaled<Scalar>(design.lead_periods / 64.0);
  all.friction = parameters(design, Type<typename Parts::Friction>{});
  all.feedforward = parameters(design, Type<typename Parts::Feedforward>{});
  all.slew = parameters(design, Type<typename Parts::Slew>{});
  all.shaper = parameters(design, Type<typename Parts::Shaper>{});
  all.regulator = parameters(design, Type<typename Parts::Regulator>{});
  all.relearning = parameters(design, Type<typename Parts::Relearning>{});
  all.vibration = parameters(design, Type<typename Parts::Vibration>{});
  all.target = parameters(design, Type<typename Parts::Target>{});
  all.standstill.hold_periods = design.standstill_hold_periods;
  all.standstill.fall_per_period = scaled<Scalar>(design.standstill_fall);
  if constexpr (Parts::Force::present) {
    all.stuck.periods = design.stuck_periods;
    all.plausibility.periods = design.implausible_periods;
    all.watch.band = scaled<Scalar>(design.settling_band);
    all.watch.patience = design.settling_patience_periods;
    all.watch.agreement = scaled<Scalar>(design.agreement);
  }
  return all;
}

}  // namespace sonoglide::configure
