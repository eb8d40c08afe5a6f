/// What an engineer may change in the field without designing the controller anew.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/control/controller.hpp"
#include "firmware/control/drive_limit.hpp"
#include "firmware/control/friction_level.hpp"
#include "firmware/encoding/crc32.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::app {

/// The order is that of the store and of the link: a new one goes to the end.
enum class Parameter : std::uint8_t {
  target,          ///< friction ratio from reset on; 1 is no drive
  drive_limit,     ///< highest amplitude, of the actuator's limit
  gain_scale,      ///< feedback, of the designed gain; 0 leaves feedforward alone
  friction_force,  ///< believed Fc, of the sensor's full scale; a calibration overrides it
  speed_floor,     ///< of the peak vibration velocity at full drive
  stuck_periods,   ///< for which a reading may stand still; the design's is the least
};

inline constexpr std::size_t parameter_count = 6;

/// Value of each parameter, in units of its last decimal place.
using ParameterValues = std::array<std::uint32_t, parameter_count>;

struct ParameterInfo {
  const char* name;
  std::uint8_t decimal_places;
  std::uint32_t lowest;
  std::uint32_t highest;
  std::uint32_t preset;  ///< compiled in

  constexpr bool allows(std::uint32_t value) const { return lowest <= value && value <= highest; }
};

inline constexpr std::uint32_t one_in_millionths = 1'000'000;

/// count / whole, rounded once; count at most whole, whole at most 2^24. 1 becomes the largest
/// number below it where the scalar ends there.
template <class Scalar>
constexpr Scalar fraction(std::uint32_t count, std::uint32_t whole) {
  if constexpr (numeric::is_fixed_point_v<Scalar>) {
    constexpr std::int64_t largest = Scalar::largest().raw();
    const std::int64_t raw =
        ((std::int64_t{count} << (Scalar::fraction_bits + 1)) + whole) / (2 * std::int64_t{whole});
    return Scalar::from_raw(static_cast<typename Scalar::Raw>(raw < largest ? raw : largest));
  } else {
    return static_cast<Scalar>(count) / static_cast<Scalar>(whole);
  }
}

/// A controller as it was designed, and the parameters that may differ from it.
///
/// To be made at compile time: it takes double.
template <class PartsT>
class FieldDesign {
 public:
  using Scalar = typename PartsT::Scalar;
  /// The designed parts, with a drive limit.
  using Parts = control::Parts<Scalar, typename PartsT::Friction, typename PartsT::Feedforward,
                               typename PartsT::Slew, typename PartsT::Shaper,
                               typename PartsT::Regulator, control::DriveLimit<Scalar>>;
  using Controller = control::Controller<Parts>;
  using Designed = typename control::Controller<PartsT>::Parameters;

  /// @param half_target  the target from reset on, friction ratio on base 2.
  /// @param design       number of the design: a store that was written under another is not used.
  constexpr FieldDesign(const Designed& designed, Scalar half_target, std::uint32_t design)
      : designed_(designed),
        infos_{{
            {"target", 6, 0, one_in_millionths, millionths(2.0 * numeric::to_real(half_target))},
            {"drive_limit", 6, 0, one_in_millionths, one_in_millionths},
            {"gain_scale", 6, 0, one_in_millionths, one_in_millionths},
            {"friction_force", 6, smallest_friction(), one_in_millionths,
             millionths(numeric::to_real(designed.friction_force))},
            {"speed_floor", 6, millionths(control::smallest_speed_floor), one_in_millionths,
             millionths(numeric::to_real(designed.speed_floor))},
            {"stuck_periods", 0, designed.stuck.periods, UINT16_MAX, designed.stuck.periods},
        }},
        half_target_(half_target),
        layout_(layout(design)) {}

  constexpr const ParameterInfo& info(std::size_t parameter) const { return infos_[parameter]; }

  constexpr ParameterValues presets() const {
    ParameterValues values{};
    for (std::size_t i = 0; i < parameter_count; ++i) {
      values[i] = infos_[i].preset;
    }
    return values;
  }

  constexpr bool allows(const ParameterValues& values) const {
    for (std::size_t i = 0; i < parameter_count; ++i) {
      if (!infos_[i].allows(values[i])) {
        return false;
      }
    }
    return true;
  }

  /// Identifies the meaning of stored values; never that of erased flash.
  constexpr std::uint32_t layout() const { return layout_; }

  /// The designed controller where nothing was changed, bit for bit.
  constexpr typename Controller::Parameters controller_parameters(
      const ParameterValues& values) const {
    typename Controller::Parameters result{
        designed_.friction_force, designed_.speed_floor,
        designed_.lead,           designed_.friction,
        designed_.feedforward,    designed_.slew,
        designed_.shaper,         designed_.regulator,
        designed_.stuck,          {control::FullDrive<Scalar>::highest()}};
    if (changed(values, Parameter::drive_limit)) {
      result.ceiling.highest = millionths_of(values, Parameter::drive_limit);
    }
    if (changed(values, Parameter::gain_scale)) {
      PartsT::Regulator::scale_gain(result.regulator, millionths_of(values, Parameter::gain_scale));
    }
    if (changed(values, Parameter::friction_force)) {
      result.friction_force = millionths_of(values, Parameter::friction_force);
    }
    if (changed(values, Parameter::speed_floor)) {
      result.speed_floor = millionths_of(values, Parameter::speed_floor);
    }
    result.stuck.periods = static_cast<std::uint16_t>(value(values, Parameter::stuck_periods));
    return result;
  }

  /// A friction ratio in millionths on base 2, as controllers take it; the designed target exactly.
  constexpr Scalar half_target(std::uint32_t millionths) const {
    return millionths == infos_[static_cast<std::size_t>(Parameter::target)].preset
               ? half_target_
               : fraction<Scalar>(millionths, 2 * one_in_millionths);
  }

 private:
  static constexpr std::uint32_t layout_version = 1;

  static constexpr std::uint32_t millionths(double value) {
    return numeric::round_half_up<std::uint32_t>(value * one_in_millionths);
  }

  /// The first millionth above the least that control::FrictionLevel accepts.
  static constexpr std::uint32_t smallest_friction() {
    const double least = numeric::to_real(control::FrictionLevel<Scalar>::smallest());
    return static_cast<std::uint32_t>(least * one_in_millionths) + 1;
  }

  static constexpr std::uint32_t value(const ParameterValues& values, Parameter parameter) {
    return values[static_cast<std::size_t>(parameter)];
  }

  static constexpr Scalar millionths_of(const ParameterValues& values, Parameter parameter) {
    return fraction<Scalar>(value(values, parameter), one_in_millionths);
  }

  constexpr bool changed(const ParameterValues& values, Parameter parameter) const {
    return value(values, parameter) != infos_[static_cast<std::size_t>(parameter)].preset;
  }

  constexpr std::uint32_t layout(std::uint32_t design) const {
    encoding::Crc32 sum;
    sum.add_word(layout_version);
    sum.add_word(design);
    for (const ParameterInfo& info : infos_) {
      sum.add_word(info.lowest);
      sum.add_word(info.highest);
      sum.add_word(info.preset);
    }
    return sum.value() & 0x7FFFFFFFU;
  }

  Designed designed_;
  std::array<ParameterInfo, parameter_count> infos_;
  Scalar half_target_;
  std::uint32_t layout_;
};

}  // namespace sonoglide::app
