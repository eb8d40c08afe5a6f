/// Values as C++ initialises them.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <type_traits>

#include "firmware/numeric/accumulator.hpp"
#include "firmware/numeric/fixed.hpp"
#include "firmware/numeric/scalar.hpp"
#include "host_sim/configure/controller_parts.hpp"

namespace sonoglide::emulated {

struct PartName {
  const char* header;  ///< in firmware/control, without .hpp
  std::string type;
  const char* inner_header = nullptr;  ///< of a part of the part
};

// Of each part; what a type is told beside its scalar is a parameter of the design.

template <class Scalar, class Parameters>
PartName part_name(configure::Type<control::TrustedFriction<Scalar>> /*part*/,
                   const Parameters& /*parameters*/) {
  return {"trusted_friction", "TrustedFriction<Scalar>"};
}

template <class Scalar, class Parameters>
PartName part_name(configure::Type<control::LearntFriction<Scalar>> /*part*/,
                   const Parameters& /*parameters*/) {
  return {"learnt_friction", "LearntFriction<Scalar>"};
}

template <class Scalar, class Parameters>
PartName part_name(configure::Type<control::CoulombFeedforward<Scalar>> /*part*/,
                   const Parameters& /*parameters*/) {
  return {"coulomb_feedforward", "CoulombFeedforward<Scalar>"};
}

template <class Scalar, class Parameters>
PartName part_name(configure::Type<control::DahlFeedforward<Scalar>> /*part*/,
                   const Parameters& /*parameters*/) {
  return {"dahl_feedforward", "DahlFeedforward<Scalar>"};
}

template <class Scalar, class Parameters>
PartName part_name(configure::Type<control::NoSlewLimit<Scalar>> /*part*/,
                   const Parameters& /*parameters*/) {
  return {"no_slew_limit", "NoSlewLimit<Scalar>"};
}

template <class Scalar, class Parameters>
PartName part_name(configure::Type<control::SlewLimit<Scalar>> /*part*/,
                   const Parameters& /*parameters*/) {
  return {"slew_limit", "SlewLimit<Scalar>"};
}

template <class Scalar, class Parameters>
PartName part_name(configure::Type<control::NoShaping<Scalar>> /*part*/,
                   const Parameters& /*parameters*/) {
  return {"no_shaping", "NoShaping<Scalar>"};
}

template <class Scalar, int MaxSpacing, std::size_t TapCount, class Parameters>
PartName part_name(configure::Type<control::NotchShaper<Scalar, MaxSpacing, TapCount>> /*part*/,
                   const Parameters& parameters) {
  return {"notch_shaper",
          TapCount == 3 ? fmt::format("NotchShaper<Scalar, {}>", parameters.spacing)
                        : fmt::format("NotchShaper<Scalar, {}, {}>", parameters.spacing, TapCount)};
}

template <class Scalar, class Parameters>
PartName part_name(configure::Type<control::NoFeedback<Scalar>> /*part*/,
                   const Parameters& /*parameters*/) {
  return {"no_feedback", "NoFeedback<Scalar>"};
}

template <class Scalar, int MaxDelay>
PartName part_name(
    configure::Type<control::IntegralRegulator<Scalar, MaxDelay>> /*part*/,
    const typename control::IntegralRegulator<Scalar, MaxDelay>::Parameters& parameters) {
  return {"integral_regulator",
          fmt::format("IntegralRegulator<Scalar, {}>", parameters.delay_periods)};
}

template <class Scalar, class Parameters>
PartName part_name(configure::Type<control::NoRelearning<Scalar>> /*part*/,
                   const Parameters& /*parameters*/) {
  return {"no_relearning", "NoRelearning<Scalar>"};
}

template <class Scalar, class Parameters>
PartName part_name(configure::Type<control::PeriodicRelearning<Scalar>> /*part*/,
                   const Parameters& /*parameters*/) {
  return {"periodic_relearning", "PeriodicRelearning<Scalar>"};
}

template <class Scalar, class Parameters>
PartName part_name(configure::Type<control::FedForward<Scalar>> /*part*/,
                   const Parameters& /*parameters*/) {
  return {"fed_forward", "FedForward<Scalar>"};
}

template <class Scalar, int MaxDelay, class Current, class Parameters>
PartName part_name(configure::Type<control::ResonantVibration<Scalar, MaxDelay, Current>> /*part*/,
                   const Parameters& parameters) {
  return {"resonant_vibration",
          fmt::format("ResonantVibration<Scalar, {}, control::{}<Scalar>>", parameters.delay,
                      Current::limits ? "CurrentLimit" : "FullCurrent"),
          Current::limits ? "current_limit" : "full_current"};
}

template <class Scalar, int MaxDelay, class Parameters>
PartName part_name(configure::Type<control::DampedVibration<Scalar, MaxDelay>> /*part*/,
                   const Parameters& parameters) {
  return {"damped_vibration", fmt::format("DampedVibration<Scalar, {}>", parameters.delay)};
}

template <class Scalar, int MaxDelay, class Reading, class Parameters>
PartName part_name(configure::Type<control::FeltVibration<Scalar, MaxDelay, Reading>> /*part*/,
                   const Parameters& parameters) {
  const bool lags = std::is_same_v<Reading, control::LaggingReading<Scalar>>;
  return {"felt_vibration",
          fmt::format("FeltVibration<Scalar, {}, control::{}<Scalar>>", parameters.delay,
                      lags ? "LaggingReading" : "PromptReading"),
          "reading_lag"};
}

template <class Parameters>
PartName part_name(configure::Type<control::ForceSensor> /*part*/,
                   const Parameters& /*parameters*/) {
  return {"force_sensing", "ForceSensor"};
}

template <class Parameters>
PartName part_name(configure::Type<control::NoForceSensor> /*part*/,
                   const Parameters& /*parameters*/) {
  return {"force_sensing", "NoForceSensor"};
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
