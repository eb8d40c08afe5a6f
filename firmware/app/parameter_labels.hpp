/// The table of a unit's parameters, the same for the unit and its host.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/encoding/crc32.hpp"

namespace sonoglide::app {

/// The order is that of the link: a new one goes to the end. The store knows them by name.
enum class Parameter : std::uint8_t {
  target,          ///< from reset on: friction ratio, 1 is no drive; or friction force, of the
                   ///< sensor's full scale, 0 is no drive
  drive_limit,     ///< highest amplitude, of the actuator's limit
  gain_scale,      ///< feedback, of the designed gain; 0 leaves feedforward alone
  friction_force,  ///< believed Fc, of the sensor's full scale; a calibration overrides it
  speed_floor,     ///< of the peak vibration velocity at full drive
  stuck_periods,   ///< for which a reading may stand still; the design's is the least
  start_on_power,  ///< 1: a unit whose parameters are whole drives from power-on
  host_timeout,    ///< seconds for which the host may be silent while the unit drives; 0: for ever
  bad_samples,     ///< of the last 32 samples so many may be unusable; the drive then stands
  force_offset,    ///< reading of the force sensor without a force, of its full scale; signed
  force_gain,      ///< true force over reading less offset
};

inline constexpr std::size_t parameter_count = 11;

/// How a parameter is called and counted.
// NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): an aggregate, whose first three are always given
struct ParameterLabel {
  const char* name;
  const char* unit;             ///< as it stands after a number: " s", or nothing
  std::uint8_t decimal_places;  ///< a value is counted in units of the last one
  bool is_signed = false;       ///< a value is in two's complement

  /// CRC-32 of name, unit and decimal places. By it the store finds the parameter in any list.
  constexpr std::uint32_t identity() const {
    encoding::Crc32 sum;
    add(name, sum);
    add(unit, sum);
    sum.add(decimal_places);
    return sum.value();
  }

 private:
  /// With the zero at its end, so that "ab", "c" is not "a", "bc".
  static constexpr void add(const char* text, encoding::Crc32& sum) {
    do {
      sum.add(static_cast<std::uint8_t>(*text));
    } while (*text++ != '\0');
  }
};

/// In the order of Parameter.
inline constexpr std::array<ParameterLabel, parameter_count> parameter_labels{{
    {"target", "", 6},
    {"drive_limit", "", 6},
    {"gain_scale", "", 6},
    {"friction_force", "", 6},
    {"speed_floor", "", 6},
    {"stuck_periods", "", 0},
    {"start_on_power", "", 0},
    {"host_timeout", " s", 3},
    {"bad_samples", "", 0},
    {"force_offset", "", 6, true},
    {"force_gain", "", 6},
}};

}  // namespace sonoglide::app
