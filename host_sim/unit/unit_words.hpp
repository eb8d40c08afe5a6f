/// What a unit says, and what it is asked about, in words.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "firmware/link/messages.hpp"
#include "host_sim/unit/unit_scales.hpp"

namespace sonoglide::unit {

/// A count of units of the last decimal place as a number, exactly.
std::string decimal(std::uint32_t value, int places);

/// A number as it is written in digits, with or without a sign and a point.
double number_of(const std::string& text);

/// @return its number, see app::Parameter; app::parameter_count if there is none
std::size_t parameter_named(const std::string& name);

/// The name of the board that a unit is.
std::string board_of(const link::Identity& told);

/// Why a unit refuses a request.
/// @param parameter  of the value that was asked for
std::string words_of(const link::Refusal& refusal, std::size_t parameter, const UnitScales& scales);

}  // namespace sonoglide::unit
