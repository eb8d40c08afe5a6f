/// Values as C++ initialises them.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

#include "firmware/friction/inverse_table.hpp"
#include "firmware/numeric/accumulator.hpp"
#include "firmware/numeric/fixed.hpp"
#include "firmware/numeric/scalar.hpp"
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

template <class Scalar, int MaxDelay, class Parameters>
PartText part_text(configure::Type<control::IntegralRegulator<Scalar, MaxDelay>> /*part*/,
                   const Parameters& parameters) {
  return part_text<control::IntegralRegulator<Scalar, MaxDelay>>(
      fmt::format(", {}", parameters.delay_periods));
}

template <class Scalar, int MaxDelay, class Parameters>
PartText part_text(configure::Type<control::AdaptiveRegulator<Scalar, MaxDelay>> /*part*/,
                   const Parameters& parameters) {
  return part_text<control::AdaptiveRegulator<Scalar, MaxDelay>>(
      fmt::format(", {}", parameters.delay_periods));
}

template <class Scalar, int MaxDelay, class Parameters>
PartText part_text(configure::Type<control::ScalingRegulator<Scalar, MaxDelay>> /*part*/,
                   const Parameters& parameters) {
  return part_text<control::ScalingRegulator<Scalar, MaxDelay>>(
      fmt::format(", {}", parameters.delay_periods));
}

/// The periods of delay that a vibration is told.
template <class Parameters>
auto delay_of(const Parameters& parameters) -> decltype(parameters.delay) {
  return parameters.delay;
}
template <class Parameters>
auto delay_of(const Parameters& parameters) -> decltype(parameters.vibration.delay) {
  return parameters.vibration.delay;
}

template <class Scalar, int MaxDelay, class Parameters>
PartText part_text(configure::Type<control::DampedVibration<Scalar, MaxDelay>> /*part*/,
                   const Parameters& parameters) {
  return part_text<control::DampedVibration<Scalar, MaxDelay>>(
      fmt::format(", {}", delay_of(parameters)));
}

template <class Scalar, int MaxDelay, class Parameters>
PartText part_text(configure::Type<control::BiasedDampedVibration<Scalar, MaxDelay>> /*part*/,
                   const Parameters& parameters) {
  return part_text<control::BiasedDampedVibration<Scalar, MaxDelay>>(
      fmt::format(", {}", delay_of(parameters)));
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

/// Writes a value as the initialiser of a variable of its type, bit for bit: a number, an array, a
/// numeric::Split, or a structure that lists its fields (see control::Parts).
///
/// @tparam Scalar  the type that the written code calls so
template <class Scalar>
class Initialiser {
 public:
  static std::string of(float value) { return fmt::format("{:a}F", static_cast<double>(value)); }
  static std::string of(double value) { return fmt::format("{:a}", value); }

  template <class Integer>
  static std::enable_if_t<std::is_integral_v<Integer>, std::string> of(Integer value) {
    return fmt::format("{}", +value);
  }

  /// The header of the part that has it names the enumeration; the number is cast to it.
  static std::string of(friction::InverseForm form) {
    return fmt::format("friction::InverseForm{{{}}}", static_cast<int>(form));
  }

  template <class Storage, int FractionBits, class Overflow>
  static std::string of(numeric::Fixed<Storage, FractionBits, Overflow> value) {
    using Number = decltype(value);
    static_assert(std::is_same_v<Number, Scalar> ||
                  std::is_same_v<Number, numeric::Accumulator<Scalar>>);
    const bool scalar = std::is_same_v<Number, Scalar>;
    return fmt::format("{}::from_raw({})", scalar ? "Scalar" : "numeric::Accumulator<Scalar>",
                       value.raw());
  }

  /// Elements in braces need a second pair around them all.
  template <class Element, std::size_t Size>
  static std::string of(const std::array<Element, Size>& values) {
    List list;
    for (const Element& value : values) {
      list("", value);
    }
    return std::is_class_v<Element> && list.text[1] == '{' ? fmt::format("{{{}}}", list.closed())
                                                           : list.closed();
  }

  static std::string of(const numeric::Split<Scalar>& value) {
    return fmt::format("{{{}, {}}}", of(value.mantissa), of(value.exponent));
  }

  template <class Structure>
  static std::enable_if_t<std::is_class_v<Structure>, std::string> of(const Structure& structure) {
    List list;
    if constexpr (!std::is_empty_v<Structure>) {
      Structure::fields(structure, list);
    }
    return list.closed();
  }

 private:
  struct List {
    std::string text = "{";

    template <class Field>
    void operator()(const char* /*name*/, const Field& field) {
      text += (text.size() > 1 ? ", " : "") + of(field);
    }
    std::string closed() const { return text + "}"; }
  };
};

}  // namespace sonoglide::emulated
