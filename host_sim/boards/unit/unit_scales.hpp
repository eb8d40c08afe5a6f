/// The numbers of a unit in SI units.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "firmware/link/scale_messages.hpp"
#include "host_sim/boards/unit/unit_link.hpp"

namespace sonoglide::unit {

/// How a unit of measurement is written.
struct UnitName {
  const char* behind_key;     ///< "_m_per_s"
  const char* behind_number;  ///< " m/s"
};
UnitName unit_name(link::ScaleUnit unit);

/// What the full scales are that a unit was built with.
class UnitScales {
 public:
  /// Asks the unit.
  /// @throws process::ProcessError  it does not answer, or its firmware is older than these questions
  explicit UnitScales(UnitLink& unit);
  explicit UnitScales(const link::FullScales& scales) : scales_(scales) {}

  const link::FullScale& operator[](link::Quantity quantity) const {
    return scales_[static_cast<std::size_t>(quantity)];
  }
  bool has(link::Quantity quantity) const {
    return (*this)[quantity].unit != link::ScaleUnit::none;
  }
  /// A friction force is the target, not a ratio.
  bool holds_force() const {
    return (*this)[link::Quantity::target].unit == link::ScaleUnit::newton;
  }

  /// Time from one step of the controller to the next.
  double step_s() const { return (*this)[link::Quantity::step].value; }

  /// As in periods.csv, with the unit: `friction_force_N`.
  std::string column_of(link::Quantity quantity) const;

  /// What a code of full scale 2^31 stands for; where periods.csv has the same number, to the last bit.
  double value_of(link::Quantity quantity, std::uint32_t code) const;
  /// The same in as few digits as it can be read back from.
  std::string text_of(link::Quantity quantity, std::uint32_t code) const;

  // ---- Parameters ----

  /// A count of units of a parameter's last decimal place as a number; of one that is a force in newtons, with
  /// as few decimal places as the count can be read back from: what was ordered is what is shown.
  std::string text_of_parameter(std::size_t parameter, std::uint32_t count) const;
  /// The number that this text is.
  double value_of_parameter(std::size_t parameter, std::uint32_t count) const;
  /// As it stands after that: " N", or nothing.
  const char* unit_of_parameter(std::size_t parameter) const;
  /// The count that is nearest. What does not fit is UINT32_MAX, which is beyond every range.
  std::uint32_t count_of_parameter(std::size_t parameter, double value) const;
  /// It is a force in newtons, which may have any number of decimal places: the link counts millionths of its
  /// full scale.
  bool is_force(std::size_t parameter) const { return force_of(parameter) > 0.0; }

  /// A friction ratio, or newtons.
  double target_of(std::uint32_t millionths) const;

 private:
  /// Full scale of a parameter in newtons; 0 where it is none.
  double force_of(std::size_t parameter) const;

  link::FullScales scales_{};
};

}  // namespace sonoglide::unit
