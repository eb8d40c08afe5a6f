/// The offset of a unit's force sensor, from what it reads without a force.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "firmware/app/parameter_labels.hpp"
#include "host_sim/boards/unit/unit_link.hpp"
#include "host_sim/boards/unit/unit_scales.hpp"

namespace sonoglide::unit {

inline constexpr auto offset_parameter = static_cast<std::size_t>(app::Parameter::force_offset);
inline constexpr std::size_t tare_readings = 256;

struct Mean {
  double value = 0.0;
  double standard_error = 0.0;
  bool equal = false;  ///< every reading is the same
};

/// Mean of readings in their order, and its standard error s/√16 with s the standard deviation of the means of
/// 16 batches of 16 in succession: noise that lasts for some readings counts as much as it should.
Mean mean_of(const std::array<double, tare_readings>& readings);

/// A unit shows force = gain (reading - offset), where a force of 0 should be 0. So the offset that its sensor
/// has is offset + force / gain.
///
/// @param offset_N  in force while the force was read
/// @param gain      the parameter force_gain
double offset_that_is(double offset_N, double force_N, double gain);

struct Tared {
  std::uint32_t before = 0;  ///< counts of the parameter force_offset
  std::uint32_t after = 0;
  double standard_error_N = 0.0;  ///< of the new offset
  bool readings_equal = false;    ///< all of them: the sensor shows no noise, or is stuck
};

/// Reads the force of a unit whose contact is unloaded, and saves the offset with which it is 0. Takes 1.3 s at
/// 115200 baud. A force that stands in a contact at rest is taken for an offset, because nothing tells them apart.
///
/// @throws process::ProcessError  the unit does not answer
/// @throws UnitRefusal  nothing is changed: the unit drives, reads no force or has parameters that nobody has
///                      confirmed; the contact slides under load; the standard error of the mean force is above
///                      0.1 % of friction_force; the offset is out of the parameter's range, as that of a
///                      converter at its rail is; it was not saved
Tared tare(UnitLink& unit, const UnitScales& scales);

/// In a line, and another one where the readings were equal.
std::vector<std::string> text_of(const Tared& tared, const UnitScales& scales);

}  // namespace sonoglide::unit
