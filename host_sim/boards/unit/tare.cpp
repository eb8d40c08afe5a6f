#include "host_sim/boards/unit/tare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "firmware/app/unit_names.hpp"
#include "firmware/control/interface/names.hpp"
#include "host_sim/boards/unit/unit_refusal.hpp"
#include "host_sim/boards/unit/unit_words.hpp"
#include "host_sim/output/number.hpp"

namespace sonoglide::unit {
namespace {

using app::Parameter;
using link::Quantity;

constexpr std::size_t batches = 16;
constexpr std::size_t batch = tare_readings / batches;
/// Of friction_force.
constexpr double largest_standard_error = 1e-3;
/// The least part of friction_force that a contact under load shows while it slides.
constexpr double least_load = 0.5;

/// What a unit is asked for a tare.
class Taring {
 public:
  Taring(UnitLink& unit, const UnitScales& scales) : unit_(unit), scales_(scales) {}

  Tared carry_out() {
    undriven();
    const auto offset = read(Parameter::force_offset);
    if (offset.lowest == offset.highest) {
      throw UnitRefusal("the unit reads no force");
    }
    const Mean force = mean_force();
    const double offset_N =
        offset_that_is(scales_.value_of_parameter(offset_parameter, offset.value), force.value,
                       value(Parameter::force_gain));
    const std::uint32_t after = scales_.count_of_parameter(offset_parameter, offset_N);
    if (after - offset.lowest > offset.highest - offset.lowest) {
      throw UnitRefusal(fmt::format(
          "force_offset would be {}; allowed is {}{}", output::quantity(offset_N, "N"),
          range_of(offset, scales_),
          force.equal
              ? "; every reading was the same, as of a converter at its rail or a sensor that is stuck"
              : ""));
    }
    const link::WriteParameter request{static_cast<std::uint8_t>(offset_parameter), after};
    require<link::ParameterWritten>(unit_, scales_, request, offset_parameter, longest_save);
    return {offset.value, after, force.standard_error / value(Parameter::force_gain), force.equal};
  }

 private:
  link::ParameterValue read(Parameter parameter) {
    const auto number = static_cast<std::size_t>(parameter);
    return require<link::ParameterValue>(
        unit_, scales_, link::ReadParameter{static_cast<std::uint8_t>(number)}, number);
  }
  double value(Parameter parameter) {
    return scales_.value_of_parameter(static_cast<std::size_t>(parameter), read(parameter).value);
  }

  /// What a unit tells that is off.
  link::Telemetry undriven() {
    const auto told = require<link::Telemetry>(unit_, scales_, link::ReadTelemetry{});
    const auto origin = static_cast<store::Origin>(told.parameters);
    if (origin == store::Origin::other_design || origin == store::Origin::damaged) {
      throw UnitRefusal(
          "see params and confirm them first");  // a saved offset would confirm them all
    }
    const auto state = static_cast<control::State>(told.state);
    if (state == control::State::fault) {
      throw UnitRefusal(fmt::format("the unit is in the fault {}: remove its cause, and stop",
                                    app::fault_name(told.fault)));
    }
    if (state != control::State::off) {
      throw UnitRefusal("stop the drive first");
    }
    return told;
  }

  /// @throws UnitRefusal  it is that of a load, or not steady
  Mean mean_force() {
    std::array<double, tare_readings> forces{};
    std::array<double, tare_readings> velocities{};
    for (std::size_t i = 0; i < tare_readings; ++i) {
      const link::Telemetry told = undriven();
      forces.at(i) = value_of(Quantity::friction_force, told.friction_force);
      velocities.at(i) = value_of(Quantity::sliding_velocity, told.sliding_velocity);
    }
    const Mean force = mean_of(forces);
    const double friction_N = value(Parameter::friction_force);
    const double speed_m_per_s = std::abs(mean_of(velocities).value);
    const double floor_m_per_s =
        value(Parameter::speed_floor) * scales_[Quantity::sliding_velocity].value;
    if (speed_m_per_s > floor_m_per_s && std::abs(force.value) > least_load * friction_N) {
      throw UnitRefusal(fmt::format(
          "the contact slides at {} under a friction of {}: lift it, or let it stand still if it is lifted",
          output::quantity(speed_m_per_s, "m/s"), output::quantity(force.value, "N")));
    }
    if (force.standard_error > largest_standard_error * friction_N) {
      throw UnitRefusal(
          fmt::format("the force is not steady: the standard error of its mean is {}; allowed is "
                      "up to {}, 0.1 % of friction_force",
                      output::quantity(force.standard_error, "N"),
                      output::quantity(largest_standard_error * friction_N, "N")));
    }
    return force;
  }

  double value_of(Quantity quantity, std::int32_t code) const {
    return scales_.value_of(quantity, static_cast<std::uint32_t>(code));
  }

  UnitLink& unit_;
  const UnitScales& scales_;
};

}  // namespace

Mean mean_of(const std::array<double, tare_readings>& readings) {
  std::array<double, batches>
      means{};  // above the first reading: equal readings then have no error
  double mean = 0.0;
  for (std::size_t i = 0; i < tare_readings; ++i) {
    const double above = readings.at(i) - readings.front();
    means.at(i / batch) += above / batch;
    mean += above / tare_readings;
  }
  double squares = 0.0;
  for (const double each : means) {
    squares += (each - mean) * (each - mean);
  }
  const bool equal = std::all_of(readings.begin(), readings.end(),
                                 [&](double each) { return each == readings.front(); });
  return {readings.front() + mean, std::sqrt(squares / (batches - 1) / batches), equal};
}

double offset_that_is(double offset_N, double force_N, double gain) {
  return offset_N + force_N / gain;
}

Tared tare(UnitLink& unit, const UnitScales& scales) {
  return Taring(unit, scales).carry_out();
}

std::vector<std::string> text_of(const Tared& tared, const UnitScales& scales) {
  std::vector<std::string> lines{
      fmt::format("force_offset was {} N, is {} N, standard error {}; saved",
                  scales.text_of_parameter(offset_parameter, tared.before),
                  scales.text_of_parameter(offset_parameter, tared.after),
                  output::quantity(tared.standard_error_N, "N"))};
  if (tared.readings_equal) {
    lines.push_back(fmt::format(
        "every one of {} readings was the same: a sensor without noise, or one that is stuck; check "
        "that a force changes it: stream friction_force",
        tare_readings));
  }
  return lines;
}

}  // namespace sonoglide::unit
