/// What an image's code calls the parts of a controller, and where it finds them.
#pragma once

#include <fmt/format.h>

#include <string>

#include "host_sim/configure/controller_parts.hpp"

namespace sonoglide::emulated {

struct PartName {
  const char* header;  ///< in firmware/control, without .hpp
  std::string type;
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

template <class Scalar, int MaxSpacing>
PartName part_name(
    configure::Type<control::NotchShaper<Scalar, MaxSpacing>> /*part*/,
    const typename control::NotchShaper<Scalar, MaxSpacing>::Parameters& parameters) {
  return {"notch_shaper", fmt::format("NotchShaper<Scalar, {}>", parameters.spacing)};
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

}  // namespace sonoglide::emulated
