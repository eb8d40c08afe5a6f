#include "host_sim/boards/emulated/controller_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "firmware/control/controller.hpp"
#include "firmware/encoding/crc32.hpp"
#include "firmware/numeric/fixed.hpp"
#include "host_sim/boards/emulated/part_text.hpp"
#include "host_sim/boards/emulated/target_text.hpp"
#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/process/printable.hpp"

namespace sonoglide::emulated {

namespace {

using Q31 = numeric::Q31<numeric::Saturating>;
using Q15 = numeric::Q15<numeric::Saturating>;

// How an image's code names a scalar.

template <class Scalar>
struct ScalarName;
template <>
struct ScalarName<float> {
  static constexpr const char* type = "float";
  static constexpr const char* header = nullptr;
};
template <>
struct ScalarName<double> {
  static constexpr const char* type = "double";
  static constexpr const char* header = nullptr;
};
template <>
struct ScalarName<Q31> {
  static constexpr const char* type = "numeric::Q31<numeric::Saturating>";
  static constexpr const char* header = "firmware/numeric/fixed.hpp";
};
template <>
struct ScalarName<Q15> {
  static constexpr const char* type = "numeric::Q15<numeric::Saturating>";
  static constexpr const char* header = "firmware/numeric/fixed.hpp";
};

std::string includes(const std::vector<ChosenPart>& parts, const char* scalar_header,
                     const char* target_header) {
  std::vector<std::string> headers{target_header, "firmware/control/controller.hpp",
                                   "firmware/link/scale_messages.hpp"};
  for (const ChosenPart& part : parts) {
    for (const std::string& header : part.text.headers) {
      headers.push_back(fmt::format("firmware/control/{}.hpp", header));
    }
  }
  if (scalar_header != nullptr) {
    headers.emplace_back(scalar_header);
  }
  std::sort(headers.begin(), headers.end());
  std::string text;
  for (const std::string& header : headers) {
    text += fmt::format("#include \"{}\"\n", header);
  }
  return text;
}

/// Number of a design: of its parts, their parameters and what these are multiples of.
std::uint32_t design_number(const std::string& types, const std::vector<ChosenPart>& parts,
                            const configure::ControlScales& scales) {
  std::string text = types;
  for (const ChosenPart& part : parts) {
    text += fmt::format("    {},  // {}\n", part.parameters, part.text.type);
  }
  text += fmt::format("{} {} {} {}", scales.step_period_s(), scales.force_N,
                      scales.velocity_m_per_s, scales.drive_amplitude_N);
  return encoding::crc32(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

std::string scale_line(const char* quantity, const char* unit, double value) {
  return fmt::format("    {{link::ScaleUnit::{}, {:a}}},  // {}: {}\n", unit, value, quantity,
                     value);
}

/// In the order of link::Quantity.
std::string scale_lines(const scene::Scene& scene, const configure::ControlDesign& design) {
  const configure::ControlScales& scales = design.scales;
  const double bias_N = scene.drive->bias_limit_N;
  return scale_line("friction_force", "newton", scales.force_N) +
         scale_line("sliding_velocity", "metre_per_second", scales.velocity_m_per_s) +
         (scene.transducer ? scale_line("amplitude", "volt", scene.drive->max_voltage_amplitude_V)
                           : scale_line("amplitude", "newton", scales.drive_amplitude_N)) +
         (design.holds_force ? scale_line("target", "newton", scales.force_N)
                             : scale_line("target", "ratio", 1.0)) +
         scale_line("bias", bias_N > 0.0 ? "newton" : "none", bias_N) +
         scale_line("step", "second", scales.step_period_s());
}

struct Header {
  std::string text;
  std::uint32_t design;
};

template <class Scalar>
Header header_in(const scene::Scene& scene, const configure::ControlDesign& design) {
  const std::vector<ChosenPart> parts = chosen_parts<Scalar>(design);
  std::string types;
  for (const ChosenPart& part : parts) {
    types += fmt::format(",\n                             control::{}", part.text.type);
  }
  const TargetText targets = target_text<Scalar>(scene, design);
  const std::uint32_t number = design_number(types, parts, design.scales);
  return {
      fmt::format(
          R"(/// The controller of the scene {}. Written by sonoglide configure: edit the scene.
#pragma once

{}
namespace sonoglide::app::configuration {{

using Scalar = {};
using Parts = control::Parts<Scalar{}>;

inline constexpr control::Controller<Parts>::Parameters parameters{{
{}}};

{}
/// What 2^31 of a code stands for, a million millionths of a target, and a step.
inline constexpr link::FullScales full_scales{{{{
{}}}}};

/// Of the drive{}.
inline constexpr double carrier_period_s = {:a};

/// Of the controller: as many carrier periods.
inline constexpr unsigned every_periods = {};
inline constexpr double step_period_s = every_periods * carrier_period_s;

/// Of the board: drive.delay_periods, and whether drive.interpolation is "linear".
inline constexpr int delay_periods = {};
inline constexpr bool interpolates = {};

/// Of the controller and its units; FieldDesign keeps stored parameters to it.
inline constexpr std::uint32_t design = {:#010x};

}}  // namespace sonoglide::app::configuration
)",
          process::printable(scene.name),
          includes(parts, ScalarName<Scalar>::header, targets.header), ScalarName<Scalar>::type,
          types,
          design.senses_force ? parameter_lines<Scalar, control::ForceSensor>(design, parts)
                              : parameter_lines<Scalar, control::NoForceSensor>(design, parts),
          targets.lines, scale_lines(scene, design), targets.drive, design.scales.carrier_period_s,
          design.scales.every_periods, scene.drive->delay_periods,
          scene.drive->interpolation == scene::Interpolation::linear, number),
      number};
}

Header header(const configure::Experiment& experiment) {
  const scene::Scene& scene = experiment.plant;
  const std::optional<configure::ControlDesign>& design = experiment.design;
  if (!design) {
    throw configure::ConfigurationError(
        "controller", "missing; required: a table [controller], of which an image is made");
  }
  switch (scene.controller->arithmetic) {
    case scene::Arithmetic::float32:
      return header_in<float>(scene, *design);
    case scene::Arithmetic::q31:
      return header_in<Q31>(scene, *design);
    case scene::Arithmetic::q15:
      return header_in<Q15>(scene, *design);
    case scene::Arithmetic::float64:
      break;
  }
  return header_in<double>(scene, *design);
}

}  // namespace

std::string controller_header(const configure::Experiment& experiment) {
  return header(experiment).text;
}

std::uint32_t design_number(const configure::Experiment& experiment) {
  return header(experiment).design;
}

}  // namespace sonoglide::emulated
