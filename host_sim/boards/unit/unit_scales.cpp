#include "host_sim/boards/unit/unit_scales.hpp"

#include <fmt/format.h>

#include <cmath>
#include <variant>

#include "firmware/app/parameter_labels.hpp"
#include "host_sim/boards/unit/unit_words.hpp"

namespace sonoglide::unit {
namespace {

constexpr double millionths = 1e6;

std::uint32_t rounded(double count, bool is_signed) {
  const double whole = std::round(count);
  if (is_signed) {
    return std::abs(whole) <= INT32_MAX
               ? static_cast<std::uint32_t>(static_cast<std::int32_t>(whole))
               : static_cast<std::uint32_t>(INT32_MAX);
  }
  return whole >= 0.0 && whole < UINT32_MAX ? static_cast<std::uint32_t>(whole) : UINT32_MAX;
}

const char* name_of(link::Quantity quantity, bool holds_force) {
  switch (quantity) {
    case link::Quantity::friction_force:
      return "friction_force";
    case link::Quantity::sliding_velocity:
      return "sliding_velocity";
    case link::Quantity::amplitude:
      return "drive_amplitude";
    case link::Quantity::target:
      return holds_force ? "target_force" : "target";
    case link::Quantity::bias:
      return "bias";
    case link::Quantity::step:
      break;
  }
  return "step";
}

}  // namespace

UnitName unit_name(link::ScaleUnit unit) {
  switch (unit) {
    case link::ScaleUnit::newton:
      return {"_N", " N"};
    case link::ScaleUnit::metre_per_second:
      return {"_m_per_s", " m/s"};
    case link::ScaleUnit::volt:
      return {"_V", " V"};
    case link::ScaleUnit::second:
      return {"_s", " s"};
    case link::ScaleUnit::none:
    case link::ScaleUnit::ratio:
      break;
  }
  return {"", ""};
}

UnitScales::UnitScales(UnitLink& unit) {
  for (std::size_t i = 0; i < scales_.size(); ++i) {
    const auto told = unit.ask<link::Scale>(link::ReadScale{static_cast<std::uint8_t>(i)});
    const auto* const scale = std::get_if<link::Scale>(&told);
    if (scale == nullptr) {
      unit.fail(
          "does not tell its scales: its firmware is older than this program; build its image again");
    }
    scales_[i] = link::full_scale_of(*scale);
  }
}

std::string UnitScales::column_of(link::Quantity quantity) const {
  return fmt::format("{}{}", name_of(quantity, holds_force()),
                     unit_name((*this)[quantity].unit).behind_key);
}

double UnitScales::value_of(link::Quantity quantity, std::uint32_t code) const {
  return static_cast<std::int32_t>(code) * 0x1p-31 * (*this)[quantity].value;
}

std::string UnitScales::text_of(link::Quantity quantity, std::uint32_t code) const {
  return fmt::format("{}", value_of(quantity, code));
}

std::string UnitScales::text_of_parameter(std::size_t parameter, std::uint32_t count) const {
  if (!is_force(parameter)) {
    return decimal(count, app::parameter_labels[parameter].decimal_places);
  }
  const double whole = app::parameter_labels[parameter].is_signed
                           ? static_cast<double>(static_cast<std::int32_t>(count))
                           : static_cast<double>(count);
  const double force_N = whole / millionths * force_of(parameter);
  constexpr int most_places = 17;
  std::string text;
  for (int places = 0; places <= most_places; ++places) {
    text = fmt::format("{:.{}f}", force_N, places);
    if (count_of_parameter(parameter, number_of(text)) == count) {
      break;
    }
  }
  return text;
}

double UnitScales::value_of_parameter(std::size_t parameter, std::uint32_t count) const {
  return number_of(text_of_parameter(parameter, count));
}

const char* UnitScales::unit_of_parameter(std::size_t parameter) const {
  return is_force(parameter) ? " N" : app::parameter_labels[parameter].unit;
}

std::uint32_t UnitScales::count_of_parameter(std::size_t parameter, double value) const {
  const app::ParameterLabel& label = app::parameter_labels[parameter];
  return is_force(parameter)
             ? rounded(value / force_of(parameter) * millionths, label.is_signed)
             : rounded(value * std::pow(10.0, label.decimal_places), label.is_signed);
}

double UnitScales::target_of(std::uint32_t count) const {
  return value_of_parameter(target_parameter, count);
}

double UnitScales::force_of(std::size_t parameter) const {
  switch (static_cast<app::Parameter>(parameter)) {
    case app::Parameter::target:
      return holds_force() ? (*this)[link::Quantity::target].value : 0.0;
    case app::Parameter::friction_force:
    case app::Parameter::force_offset:
      return (*this)[link::Quantity::friction_force].value;
    default:
      return 0.0;
  }
}

}  // namespace sonoglide::unit
