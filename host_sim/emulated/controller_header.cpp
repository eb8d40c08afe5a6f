#include "host_sim/emulated/controller_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "firmware/encoding/crc32.hpp"
#include "firmware/numeric/accumulator.hpp"
#include "firmware/numeric/scalar.hpp"
#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/emulated/float_number.hpp"
#include "host_sim/loop/carrier_grid.hpp"
#include "host_sim/text/printable.hpp"

namespace sonoglide::emulated {
namespace {

/// How the scalar is written: its type, and a number of it or of its accumulator, bit for bit.
struct ScalarText {
  const char* type;
  const char* header;
  std::string (*number)(double value);
  std::string (*accumulated)(double value);
};

std::string double_number(double value) {
  return fmt::format("{:a}", value);
}

using Q31 = numeric::Q31<numeric::Saturating>;
using Q15 = numeric::Q15<numeric::Saturating>;

template <class Fixed>
std::string fixed_number(double value) {
  return fmt::format("Scalar::from_raw({})", numeric::from_real<Fixed>(value).raw());
}

std::string q15_accumulated(double value) {
  return fmt::format("numeric::Accumulator<Scalar>::from_raw({})",
                     numeric::from_real<numeric::Accumulator<Q15>>(value).raw());
}

ScalarText scalar_text(scene::Arithmetic arithmetic) {
  switch (arithmetic) {
    case scene::Arithmetic::float32:
      return {"float", nullptr, float_number, float_number};
    case scene::Arithmetic::q31:
      return {"numeric::Q31<numeric::Saturating>", "firmware/numeric/fixed.hpp", fixed_number<Q31>,
              fixed_number<Q31>};
    case scene::Arithmetic::q15:
      return {"numeric::Q15<numeric::Saturating>", "firmware/numeric/fixed.hpp", fixed_number<Q15>,
              q15_accumulated};
    case scene::Arithmetic::float64:
      break;
  }
  return {"double", nullptr, double_number, double_number};
}

/// One part of the controller: its header, its type, and the initialiser of its parameters.
struct PartText {
  const char* header;
  std::string type;
  std::string parameters;
};

PartText friction_part(const configure::ControlDesign& design, const ScalarText& scalar) {
  if (!design.calibrated) {
    return {"trusted_friction", "TrustedFriction<Scalar>", "{}"};
  }
  return {
      "learnt_friction", "LearntFriction<Scalar>",
      fmt::format("{{{}, {}, {}, {}}}", design.calibration_settle_periods,
                  design.calibration_average_periods, scalar.accumulated(design.calibration_weight),
                  design.calibration_total_periods)};
}

PartText feedforward_part(const scene::Scene& scene, const configure::ControlDesign& design,
                          const ScalarText& scalar) {
  if (scene::friction_map(scene.friction.law) == scene::FrictionMap::coulomb) {
    return {"coulomb_feedforward", "CoulombFeedforward<Scalar>", "{}"};
  }
  const numeric::Split<double> force = numeric::split(design.contact_force);
  return {"dahl_feedforward", "DahlFeedforward<Scalar>",
          fmt::format("{{{{{}, {}}}}}", scalar.number(force.mantissa), force.exponent)};
}

PartText slew_part(const configure::ControlDesign& design, const ScalarText& scalar) {
  if (!design.slew_limited) {
    return {"no_slew_limit", "NoSlewLimit<Scalar>", "{}"};
  }
  return {"slew_limit", "SlewLimit<Scalar>",
          fmt::format("{{{}}}", scalar.number(design.slew_per_period))};
}

PartText shaper_part(const configure::ControlDesign& design, const ScalarText& scalar) {
  if (!design.shaped) {
    return {"no_shaping", "NoShaping<Scalar>", "{}"};
  }
  const auto& taps = design.notch_taps;
  return {"notch_shaper", fmt::format("NotchShaper<Scalar, {}>", design.notch_spacing),
          fmt::format("{{{{{}, {}, {}}}, {}}}", scalar.number(taps[0]), scalar.number(taps[1]),
                      scalar.number(taps[2]), design.notch_spacing)};
}

PartText regulator_part(const configure::ControlDesign& design, const ScalarText& scalar) {
  if (design.integral_gain == 0.0) {
    return {"no_feedback", "NoFeedback<Scalar>", "{}"};
  }
  return {"integral_regulator",
          fmt::format("IntegralRegulator<Scalar, {}>", design.reference_delay_periods),
          fmt::format("{{{}, {}, {}, {}, {}}}", scalar.number(design.integral_gain),
                      scalar.number(design.reference_keep), design.hold_periods,
                      design.rest_periods, design.reference_delay_periods)};
}

PartText relearning_part(const configure::ControlDesign& design, const ScalarText& scalar) {
  if (!design.relearns) {
    return {"no_relearning", "NoRelearning<Scalar>", "{}"};
  }
  return {"periodic_relearning", "PeriodicRelearning<Scalar>",
          fmt::format("{{{}, {}, {}, {}, {}, {}, {}}}", design.relearn_every_periods,
                      design.relearn_quiet_periods, scalar.number(design.relearn_travel),
                      design.relearn_reading_periods, design.relearn_return_periods,
                      design.relearn_average_periods, scalar.accumulated(design.relearn_weight))};
}

/// The carrier period, counted from 0, whose sample a target step is in force for: the sample is
/// taken at the period's end.
std::uint32_t first_period(const loop::CarrierGrid& grid, double time_s) {
  constexpr std::uint64_t most_periods = 0xffffffff;
  const std::uint64_t period = std::max<std::uint64_t>(1, grid.at_or_after(time_s)) - 1;
  if (period > most_periods) {
    throw configure::ConfigurationError(
        "controller.target_friction_ratio",
        fmt::format("a step at {:g} s is out of an image's reach; allowed: up to {:g} s", time_s,
                    static_cast<double>(most_periods) * grid.period_s()));
  }
  return static_cast<std::uint32_t>(period);
}

std::string target_steps(const scene::Scene& scene, const ScalarText& scalar) {
  const loop::CarrierGrid grid(scene);
  std::string text;
  for (const scene::TargetStep& step : scene.controller->target_friction_ratio) {
    text += fmt::format("    {{{}, {}}},  // {}\n", first_period(grid, step.time_s),
                        scalar.number(0.5 * step.friction_ratio), step.friction_ratio);
  }
  return text;
}

std::string includes(const std::vector<PartText>& parts, const ScalarText& scalar) {
  std::vector<std::string> headers{"firmware/app/target_schedule.hpp",
                                   "firmware/control/controller.hpp"};
  for (const PartText& part : parts) {
    headers.push_back(fmt::format("firmware/control/{}.hpp", part.header));
  }
  if (scalar.header != nullptr) {
    headers.emplace_back(scalar.header);
  }
  std::sort(headers.begin(), headers.end());
  std::string text;
  for (const std::string& header : headers) {
    text += fmt::format("#include \"{}\"\n", header);
  }
  return text;
}

/// Number of a design: of its parts, its parameters and what they are multiples of.
std::uint32_t design_number(const std::string& types, const std::string& parameters,
                            const configure::ControlScales& scales) {
  const std::string text =
      fmt::format("{}{}{} {} {} {}", types, parameters, scales.carrier_period_s, scales.force_N,
                  scales.velocity_m_per_s, scales.drive_amplitude_N);
  return encoding::crc32(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

}  // namespace

std::string controller_header(const scene::Scene& scene) {
  if (!scene.controller) {
    throw configure::ConfigurationError(
        "controller", "missing; required: a table [controller], of which an image is made");
  }
  const configure::ControlDesign design = configure::design_control(scene);
  const ScalarText scalar = scalar_text(scene.controller->arithmetic);
  const std::vector<PartText> parts{
      friction_part(design, scalar),  feedforward_part(scene, design, scalar),
      slew_part(design, scalar),      shaper_part(design, scalar),
      regulator_part(design, scalar), relearning_part(design, scalar)};
  std::string types;
  std::string parameters;
  for (const PartText& part : parts) {
    types += fmt::format(",\n                             control::{}", part.type);
    parameters += fmt::format("    {},  // {}\n", part.parameters, part.type);
  }
  return fmt::format(
      R"(/// The controller of the scene {}. Written by sonoglide configure: edit the scene.
#pragma once

{}
namespace sonoglide::app::configuration {{

using Scalar = {};
using Parts = control::Parts<Scalar{}>;

inline constexpr control::Controller<Parts>::Parameters parameters{{
    {},  // friction_force, of {} N
    {},  // smallest_friction
    {},  // speed_floor, of {} m/s
    {},  // lead
{}    {{{}, {}}},  // standstill
    {{{}}},  // stuck
    {{{}}},  // plausibility
    {{{}, {}, {}}},  // watch
    {{}},  // ceiling
    {{}},  // samples
}};

inline constexpr TargetStep<Scalar> target_steps[] = {{
{}}};

/// Of the drive; a step answers each.
inline constexpr double carrier_period_s = {:a};

/// Of the controller and its units; FieldDesign keeps stored parameters to it.
inline constexpr std::uint32_t design = {:#010x};

}}  // namespace sonoglide::app::configuration
)",
      text::printable(scene.name), includes(parts, scalar), scalar.type, types,
      scalar.number(design.friction_force), design.scales.force_N,
      scalar.number(design.smallest_friction), scalar.number(design.speed_floor),
      design.scales.velocity_m_per_s, scalar.number(design.lead_periods / 64.0), parameters,
      design.standstill_hold_periods, scalar.number(design.standstill_fall), design.stuck_periods,
      design.implausible_periods, scalar.number(design.settling_band),
      design.settling_patience_periods, scalar.number(design.agreement),
      target_steps(scene, scalar), design.scales.carrier_period_s,
      design_number(types, parameters, design.scales));
}

}  // namespace sonoglide::emulated
