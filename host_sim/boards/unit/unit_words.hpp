/// What a unit says, and what it is asked about, in words.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "firmware/app/parameter_labels.hpp"
#include "firmware/link/messages.hpp"
#include "host_sim/boards/unit/unit_scales.hpp"

namespace sonoglide::unit {

inline constexpr auto target_parameter = static_cast<std::size_t>(app::Parameter::target);

/// A count of units of the last decimal place as a number, exactly.
std::string decimal(std::uint32_t value, int places);

/// Digits, with or without a minus sign and a point.
bool is_number(const std::string& text);

/// Of such a text.
double number_of(const std::string& text);

/// @return its number, see app::Parameter; app::parameter_count if there is none
std::size_t parameter_named(const std::string& name);

/// The name of the board that a unit is.
std::string board_of(const link::Identity& told);

/// Why a unit refuses a request.
/// @param parameter  of the value that was asked for
std::string words_of(const link::Refusal& refusal, std::size_t parameter, const UnitScales& scales);

/// A text as a count of units of a parameter's last decimal place.
struct ReadValue {
  std::uint32_t count = 0;
  std::string error;  ///< why it is none; empty where it is one
};

/// Of a force in newtons the nearest count, of others the same number.
/// @return the largest count of what is beyond every range: the unit names its own
ReadValue read_value(const std::string& text, std::size_t parameter, const UnitScales& scales);

// What it has answered, each in a line.

std::string range_of(const link::ParameterValue& value, const UnitScales& scales);
std::string text_of(const link::ParameterValue& value, const UnitScales& scales);
std::string text_of(const link::Telemetry& told, const UnitScales& scales);
std::string text_of(const UnitScales& scales);
std::string text_of(const link::Identity& told);
/// Of a hal::ResetCause, as it follows "after".
const char* cause_name(std::uint8_t cause);
std::string text_of(const link::History& told);
/// @param before  what it came before
std::string text_of(const link::KeptException& told, const std::string& before);

}  // namespace sonoglide::unit
