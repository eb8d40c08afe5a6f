/// Controllers for the tests: compositions of parts, and numbers for them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <type_traits>

#include "firmware/control/controller.hpp"
#include "firmware/control/feedback/integral_regulator.hpp"
#include "firmware/control/friction/coulomb_feedforward.hpp"
#include "firmware/control/friction/dahl_feedforward.hpp"
#include "firmware/control/friction/friction_tracking.hpp"
#include "firmware/control/friction/learnt_friction.hpp"
#include "firmware/control/friction/periodic_relearning.hpp"
#include "firmware/control/limits/drive_limit.hpp"
#include "firmware/control/limits/notch_shaper.hpp"
#include "firmware/control/limits/slew_limit.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

inline constexpr int longest_spacing = 8;
inline constexpr int longest_delay = 32;

/// Everything in use.
template <class S>
using FullParts = Parts<S, LearntFriction<S>, DahlFeedforward<S>, SlewLimit<S>,
                        NotchShaper<S, longest_spacing>, IntegralRegulator<S, longest_delay>>;
/// What a scene at Table 1 without calibration gets.
template <class S>
using ShapedParts = Parts<S, TrustedFriction<S>, DahlFeedforward<S>, NoSlewLimit<S>,
                          NotchShaper<S, longest_spacing>, IntegralRegulator<S, longest_delay>>;
/// With a notch for a mode that is not known exactly.
template <class S>
using RobustParts = Parts<S, TrustedFriction<S>, DahlFeedforward<S>, NoSlewLimit<S>,
                          NotchShaper<S, longest_spacing, 5>, IntegralRegulator<S, longest_delay>>;
template <class S>
using LearningParts = Parts<S, LearntFriction<S>, DahlFeedforward<S>, NoSlewLimit<S>,
                            NotchShaper<S, longest_spacing>, IntegralRegulator<S, longest_delay>>;
/// What a scene gets that learns the friction force again and again.
template <class S>
using RelearningParts = Parts<S, TrustedFriction<S>, DahlFeedforward<S>, NoSlewLimit<S>,
                              NotchShaper<S, longest_spacing>, IntegralRegulator<S, longest_delay>,
                              PeriodicRelearning<S>>;
/// What learns friction, contact and gain while driving.
template <class S>
using TrackingParts = Parts<S, TrustedFriction<S>, TrackedDahlFeedforward<S>, NoSlewLimit<S>,
                            NotchShaper<S, longest_spacing>, IntegralRegulator<S, longest_delay>,
                            FrictionTracking<S>>;
template <class S>
using SlewingParts = Parts<S, TrustedFriction<S>, DahlFeedforward<S>, SlewLimit<S>, NoShaping<S>,
                           IntegralRegulator<S, longest_delay>>;
template <class S>
using UnshapedParts = Parts<S, TrustedFriction<S>, DahlFeedforward<S>, NoSlewLimit<S>, NoShaping<S>,
                            IntegralRegulator<S, longest_delay>>;
/// Nothing that can be left out.
template <class S>
using BareParts = Parts<S, TrustedFriction<S>, CoulombFeedforward<S>, NoSlewLimit<S>, NoShaping<S>,
                        IntegralRegulator<S, longest_delay>>;

/// Parameters as real numbers. As preset: Table 1 of the paper at 60 kHz and a drive limit of
/// 1920 N, the sensor's full scale being 2 Fc; a speed of 0.1 is 26.7 mm/s.
struct Design {
  double friction_force = 0.5;
  double smallest_friction = 1.0 / 1024.0;
  double contact_force = 1.0108;
  double speed_floor = 0.026;
  double lead_periods = 1.5;
  double gain = 0.148;
  double keep = 0.0;
  std::uint8_t delay_periods = 1;
  std::uint16_t hold_periods = 5;
  std::uint16_t rest_periods = 20;
  std::uint16_t stuck_periods = 11;
  std::uint16_t implausible_periods = 21;
  std::uint32_t standstill_hold_periods = 5000;
  double standstill_fall = 0.0078125;
  double settling_band = 0.005;
  std::uint16_t settling_patience_periods = 60;
  double agreement = 0.8;
  std::array<double, 3> taps = {0.6323, -0.2646, 0.6323};
  std::array<double, 5> robust_taps = {0.4044, -0.3367, 0.8646, -0.3367, 0.4044};
  std::uint8_t spacing = 1;
  double slew_per_period = 0.02;
  std::uint32_t settle_periods = 20;
  std::uint32_t average_periods = 40;
  std::uint32_t total_periods = 0;
  std::uint32_t relearn_every_periods = 1000;
  std::uint16_t relearn_reading_periods = 2;
  double relearn_travel = 0.0075;  ///< half a carrier period at full drive's velocity
  std::uint16_t tracking_wait_periods = 12;
  std::uint8_t tracking_average_periods = 8;
  double tracking_deviation = 0.003;
  double tracking_noise = 0.0005;
  double tracking_scatter = 0.006;
  double tracking_certain = 0.01;
  double gain_deviation = 0.02;
  double drive_limit = 1.0;
};

/// A part without parameters has nothing to fill in.
template <class S, class Empty>
std::enable_if_t<std::is_empty_v<Empty>> fill(const Design& /*design*/, Empty& /*parameters*/) {}

template <class S>
void fill(const Design& design, typename LearntFriction<S>::Parameters& parameters) {
  parameters = {design.settle_periods, design.average_periods,
                numeric::from_real<numeric::Accumulator<S>>(1.0 / design.average_periods),
                design.total_periods, numeric::from_code<S>(INT32_MAX)};
}

template <class S>
void fill(const Design& design, typename PeriodicRelearning<S>::Parameters& parameters) {
  const auto shaping = static_cast<std::uint16_t>(2 * design.spacing);
  parameters = {design.relearn_every_periods,
                shaping,
                numeric::from_real<S>(design.relearn_travel),
                design.relearn_reading_periods,
                static_cast<std::uint16_t>(shaping + 2),
                1,
                numeric::from_real<numeric::Accumulator<S>>(numeric::from_code<double>(INT32_MAX))};
}

template <class S>
void fill(const Design& design, typename FrictionTracking<S>::Parameters& parameters) {
  const auto variance = [](double deviation) {
    return numeric::from_real<S>(deviation * deviation);
  };
  parameters = {
      {design.tracking_wait_periods, design.tracking_average_periods,
       numeric::from_real<numeric::Accumulator<S>>(1.0 / design.tracking_average_periods)},
      {numeric::from_real<S>(design.tracking_deviation / 4.0),
       numeric::from_real<S>(design.tracking_noise / 4.0),
       numeric::from_real<S>(design.tracking_scatter / 2.0),
       {variance(0.3), variance(0.5), variance(design.gain_deviation)}},
      variance(design.tracking_certain),
      static_cast<std::uint16_t>(4 *
                                 (design.tracking_wait_periods + design.tracking_average_periods)),
      numeric::from_real<S>(std::min(0.75, 1.0 - 3.0 * design.gain_deviation))};
}

template <class S>
void fill(const Design& design, typename DahlFeedforward<S>::Parameters& parameters) {
  const numeric::Split<double> force = numeric::split(design.contact_force);
  parameters = {{numeric::from_real<S>(force.mantissa), force.exponent}};
}

template <class S>
void fill(const Design& design, typename SlewLimit<S>::Parameters& parameters) {
  parameters = {numeric::from_real<S>(design.slew_per_period)};
}

template <class S>
void fill(const Design& design, typename NotchShaper<S, longest_spacing>::Parameters& parameters) {
  for (std::size_t i = 0; i < design.taps.size(); ++i) {
    parameters.taps[i] = numeric::from_real<S>(design.taps[i]);
  }
  parameters.spacing = design.spacing;
}

template <class S>
void fill(const Design& design,
          typename NotchShaper<S, longest_spacing, 5>::Parameters& parameters) {
  for (std::size_t i = 0; i < design.robust_taps.size(); ++i) {
    parameters.taps[i] = numeric::from_real<S>(design.robust_taps[i]);
  }
  parameters.spacing = design.spacing;
}

template <class S>
void fill(const Design& design, typename DriveLimit<S>::Parameters& parameters) {
  parameters = {numeric::from_real<S>(design.drive_limit)};
}

template <class PartsT>
typename Controller<PartsT>::Parameters parameters(const Design& design) {
  using S = typename PartsT::Scalar;
  typename Controller<PartsT>::Parameters result{};
  result.friction_force = numeric::from_real<S>(design.friction_force);
  result.smallest_friction = numeric::from_real<S>(design.smallest_friction);
  result.speed_floor = numeric::from_real<S>(design.speed_floor);
  result.lead = numeric::from_real<S>(design.lead_periods / 64.0);
  fill<S>(design, result.friction);
  fill<S>(design, result.feedforward);
  fill<S>(design, result.slew);
  fill<S>(design, result.shaper);
  result.regulator = {numeric::from_real<S>(design.gain), numeric::from_real<S>(design.keep),
                      design.hold_periods, design.rest_periods, design.delay_periods};
  fill<S>(design, result.relearning);
  result.standstill = {design.standstill_hold_periods,
                       numeric::from_real<S>(design.standstill_fall)};
  result.stuck = {design.stuck_periods};
  result.plausibility = {design.implausible_periods};
  result.watch = {numeric::from_real<S>(design.settling_band), design.settling_patience_periods,
                  numeric::from_real<S>(design.agreement)};
  fill<S>(design, result.ceiling);
  return result;
}

}  // namespace sonoglide::control
