/// How the parts of a controller and their parameters are told in its header.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "firmware/control/controller.hpp"
#include "host_sim/boards/emulated/initialiser.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/configure/controller_parameters.hpp"
#include "host_sim/configure/controller_parts.hpp"

namespace sonoglide::emulated {

/// How an image's code names a part.
struct PartText {
  std::vector<std::string> headers;  ///< in firmware/control, without .hpp
  std::string type;
};

/// @param told  what its type is told beside its scalar
template <class Part>
PartText part_text(const std::string& told = {}) {
  return {{Part::part_name.header}, fmt::format("{}<Scalar{}>", Part::part_name.type, told)};
}

template <template <class> class Part, class Scalar, class Parameters>
PartText part_text(configure::Type<Part<Scalar>> /*part*/, const Parameters& /*parameters*/) {
  return part_text<Part<Scalar>>();
}

template <class Scalar, int MaxSpacing, std::size_t TapCount, class Parameters>
PartText part_text(configure::Type<control::NotchShaper<Scalar, MaxSpacing, TapCount>> /*part*/,
                   const Parameters& parameters) {
  return part_text<control::NotchShaper<Scalar, MaxSpacing, TapCount>>(
      TapCount == 3 ? fmt::format(", {}", parameters.spacing)
                    : fmt::format(", {}, {}", parameters.spacing, TapCount));
}

/// The periods of delay that a part is told.
template <class Parameters>
auto delay_of(const Parameters& parameters) -> decltype(parameters.delay_periods) {
  return parameters.delay_periods;
}
template <class Parameters>
auto delay_of(const Parameters& parameters) -> decltype(parameters.delay) {
  return parameters.delay;
}
template <class Parameters>
auto delay_of(const Parameters& parameters) -> decltype(parameters.vibration.delay) {
  return parameters.vibration.delay;
}

/// A regulator or a vibration: a part whose parameters have a delay.
template <template <class, int> class Part, class Scalar, int MaxDelay, class Parameters>
auto part_text(configure::Type<Part<Scalar, MaxDelay>> /*part*/, const Parameters& parameters)
    -> decltype(delay_of(parameters), PartText()) {
  return part_text<Part<Scalar, MaxDelay>>(fmt::format(", {}", delay_of(parameters)));
}

/// A regulator in another part, whose parameters hold its own.
template <template <class> class Outer, class Regulator, class Parameters>
PartText text_around(const Parameters& parameters) {
  PartText text = part_text(configure::Type<Regulator>{}, parameters.regulator);
  text.headers.emplace_back(Outer<Regulator>::part_name.header);
  text.type = fmt::format("{}<control::{}>", Outer<Regulator>::part_name.type, text.type);
  return text;
}

template <class Regulator, class Parameters>
PartText part_text(configure::Type<control::ContactLead<Regulator>> /*part*/,
                   const Parameters& parameters) {
  return text_around<control::ContactLead, Regulator>(parameters);
}

template <class Regulator, class Parameters>
PartText part_text(configure::Type<control::ContactForesight<Regulator>> /*part*/,
                   const Parameters& parameters) {
  return text_around<control::ContactForesight, Regulator>(parameters);
}

/// A vibration that has a part of its own.
template <template <class, int, class> class Vibration, class Scalar, int MaxDelay, class Inner,
          class Parameters>
PartText part_text(configure::Type<Vibration<Scalar, MaxDelay, Inner>> /*part*/,
                   const Parameters& parameters) {
  PartText text = part_text<Vibration<Scalar, MaxDelay, Inner>>(
      fmt::format(", {}, control::{}<Scalar>", delay_of(parameters), Inner::part_name.type));
  text.headers.emplace_back(Inner::part_name.header);
  return text;
}

/// Of a part without a scalar.
template <class Part, class Parameters>
PartText part_text(configure::Type<Part> /*part*/, const Parameters& /*parameters*/) {
  return {{Part::part_name.header}, Part::part_name.type};
}

/// One part of the controller: what its parameters are called, its text, and the initialiser of its
/// parameters.
struct ChosenPart {
  std::string slot;
  PartText text;
  std::string parameters;
};

/// Visits the choices of configure::ControllerParts.
template <class Scalar>
struct PartChoices {
  const configure::ControlDesign& design;
  std::vector<ChosenPart> chosen;

  template <class Choice>
  void operator()(const char* slot, const Choice& choice) {
    std::visit(
        [&](auto part) {
          const auto parameters = configure::parameters(design, part);
          chosen.push_back(
              {slot, part_text(part, parameters), Initialiser<Scalar>::of(parameters)});
        },
        choice);
  }
};

template <class Scalar>
std::vector<ChosenPart> chosen_parts(const configure::ControlDesign& design) {
  PartChoices<Scalar> parts{design, {}};
  configure::ControllerParts<Scalar>(design).fields(parts);
  return parts.chosen;
}

/// Visits the parameters of a controller: a line for each, those of the chosen parts as they are
/// told in `parts`.
template <class Scalar>
struct ParameterLines {
  const std::vector<ChosenPart>& parts;
  const configure::ControlScales& scales;
  std::string text;

  template <class Field>
  void operator()(const std::string& name, const Field& field) {
    const auto part = std::find_if(parts.begin(), parts.end(),
                                   [&](const ChosenPart& each) { return each.slot == name; });
    text += part == parts.end() ? line(Initialiser<Scalar>::of(field), name + base(name))
                                : line(part->parameters, part->text.type);
  }

  static std::string line(const std::string& value, const std::string& comment) {
    return fmt::format("    {},  // {}\n", value, comment);
  }

  /// What a number is a multiple of.
  std::string base(const std::string& name) const {
    if (name == "friction_force") {
      return fmt::format(", of {} N", scales.force_N);
    }
    return name == "speed_floor" ? fmt::format(", of {} m/s", scales.velocity_m_per_s) : "";
  }
};

/// The parameters that are no part's are the same with any parts.
template <class Scalar, class Force>
std::string parameter_lines(const configure::ControlDesign& design,
                            const std::vector<ChosenPart>& parts) {
  using Parts = control::Parts<Scalar, control::TrustedFriction<Scalar>,
                               control::CoulombFeedforward<Scalar>, control::NoSlewLimit<Scalar>,
                               control::NoShaping<Scalar>, control::NoFeedback<Scalar>,
                               control::NoRelearning<Scalar>, control::FedForward<Scalar>, Force>;
  ParameterLines<Scalar> lines{parts, design.scales, {}};
  const auto parameters = configure::controller_parameters<Parts>(design);
  control::Controller<Parts>::Parameters::fields(parameters, lines);
  return lines.text;
}

}  // namespace sonoglide::emulated
