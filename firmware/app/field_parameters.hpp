/// Parameters that an engineer may change in the field, without a new design of the controller.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "firmware/app/force_calibration.hpp"
#include "firmware/app/parameter_labels.hpp"
#include "firmware/control/controller.hpp"
#include "firmware/control/friction/friction_level.hpp"
#include "firmware/control/limits/drive_limit.hpp"
#include "firmware/control/limits/sample_inspection.hpp"
#include "firmware/encoding/crc32.hpp"
#include "firmware/link/scale_messages.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::app {

/// The number of samples among which bad_samples counts.
inline constexpr std::uint8_t sample_window = 32;

/// Preset of host_timeout for a host that asks at least ten times a second.
inline constexpr std::uint32_t default_timeout_ms = 100;

/// Value of each parameter, in units of its last decimal place.
using ParameterValues = std::array<std::uint32_t, parameter_count>;

/// The value in force if the stored one is of another design, or if a record is damaged.
enum class Inheritance : std::uint8_t {
  none,    ///< the value compiled in
  value,   ///< the stored value, moved to the nearer end of the range if it is outside
  higher,  ///< the higher one of the stored value and the value compiled in
};

/// What values a parameter may have under a design. A range whose lowest is the higher one as unsigned numbers
/// is of signed ones, in two's complement.
struct ParameterRange {
  Inheritance inheritance;
  std::uint32_t lowest;
  std::uint32_t highest;
  std::uint32_t preset;  ///< compiled in

  constexpr bool allows(std::uint32_t value) const { return value - lowest <= highest - lowest; }

  /// The value to use in place of one that was stored under another design.
  constexpr std::uint32_t inherited(std::uint32_t value) const {
    const std::uint32_t least = inheritance == Inheritance::higher ? preset : lowest;
    const std::uint32_t sign = lowest > highest ? 0x80000000U : 0U;  // orders signed numbers
    return inheritance == Inheritance::none
               ? preset
               : numeric::clamp(value ^ sign, least ^ sign, highest ^ sign) ^ sign;
  }
};

/// At compile time: ParameterLabel::identity of each parameter.
inline constexpr std::array<std::uint32_t, parameter_count> parameter_identities = [] {
  std::array<std::uint32_t, parameter_count> result{};
  for (std::size_t i = 0; i < parameter_count; ++i) {
    result[i] = parameter_labels[i].identity();
  }
  return result;
}();

using ParameterRanges = std::array<ParameterRange, parameter_count>;

/// What a unit tells its design by, in its store and to its host: the number of the controller's design
/// with the names and ranges of its parameters.
constexpr std::uint32_t design_number(std::uint32_t controller, const ParameterRanges& ranges) {
  encoding::Crc32 sum;
  sum.add_word(controller);
  for (const std::uint32_t identity : parameter_identities) {
    sum.add_word(identity);
  }
  for (const ParameterRange& range : ranges) {
    sum.add_word(range.lowest);
    sum.add_word(range.highest);
    sum.add_word(range.preset);
  }
  return sum.value();
}

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

/// count / whole rounded down, to a number whose code is exact; count below whole, whole at most
/// 2^31. Digit by digit, as a processor of 32 bits has no quotient of 64 bits.
template <class Scalar>
constexpr Scalar fraction_below(std::uint32_t count, std::uint32_t whole) {
  std::uint32_t code = 0;
  for (int digit = 0; digit < 31; ++digit) {
    count *= 2;
    code *= 2;
    if (count >= whole) {
      count -= whole;
      ++code;
    }
  }
  int unused_digits = 0;
  if constexpr (numeric::is_fixed_point_v<Scalar>) {
    unused_digits = 31 - Scalar::fraction_bits;
  } else {
    while (code >> unused_digits >= std::uint64_t{1} << std::numeric_limits<Scalar>::digits) {
      ++unused_digits;
    }
  }
  return numeric::from_code<Scalar>(
      static_cast<std::int32_t>(code >> unused_digits << unused_digits));
}

/// A controller as it was designed, and the parameters that may differ from it.
///
/// To be made at compile time: it takes double.
template <class PartsT>
class FieldDesign {
 public:
  using Scalar = typename PartsT::Scalar;
  /// Of an observed vibration every sample is needed.
  using Samples = std::conditional_t<PartsT::Vibration::observed, control::StrictSamples,
                                     control::TolerantSamples>;
  /// The designed parts, with a drive limit and, where it may be, a tolerance of unusable samples.
  using Parts = control::Parts<Scalar, typename PartsT::Friction, typename PartsT::Feedforward,
                               typename PartsT::Slew, typename PartsT::Shaper,
                               typename PartsT::Regulator, typename PartsT::Relearning,
                               typename PartsT::Vibration, typename PartsT::Force,
                               typename PartsT::Target, control::DriveLimit<Scalar>, Samples>;
  using Controller = control::Controller<Parts>;
  using Calibration = CalibrationOf<Controller>;
  using Designed = typename control::Controller<PartsT>::Parameters;

  /// @param designed     the controller's parameters, as sonoglide configure writes them.
  /// @param target      from reset on, see Controller::set_target.
  /// @param design      number of the design: of a store that was written under another, only
  ///                    the limits are taken, and the unit waits to be told.
  /// @param full_scales  told to the host, no more
  /// @param period_s    of the loop, which a step answers; above 1e-6 s.
  /// @param timeout_ms  host_timeout as compiled in: 0: a silent host is borne for ever.
  constexpr FieldDesign(const Designed& designed, Scalar target, std::uint32_t design,
                        const link::FullScales& full_scales, double period_s,
                        std::uint32_t timeout_ms)
      : designed_(designed),
        ranges_{{
            {Inheritance::none, 0, one_in_millionths,
             millionths(target_base * numeric::to_real(target))},
            {Inheritance::value, 0, one_in_millionths, one_in_millionths},
            {Inheritance::value, 0, one_in_millionths, one_in_millionths},
            {Inheritance::none, smallest_friction(), one_in_millionths,
             millionths(numeric::to_real(designed.friction_force))},
            {Inheritance::higher, millionths(control::smallest_speed_floor), one_in_millionths,
             millionths(numeric::to_real(designed.speed_floor))},
            stuck_range(designed.stuck),
            {Inheritance::value, 0, 1, 0},
            {Inheritance::value, 0, longest_timeout_ms, timeout_ms},
            {Inheritance::none, 0, tolerates_samples ? sample_window - 1 : 0, 0},
            {Inheritance::value, 0U - largest_offset, largest_offset, 0},
            {Inheritance::value, lowest_gain, highest_gain, one_in_millionths},
        }},
        target_(target),
        design_(design_number(design, ranges_)),
        full_scales_(full_scales),
        periods_per_ms_(numeric::round_half_up<std::uint32_t>(1e-3 / period_s * one_in_fraction)) {}

  constexpr const ParameterRange& range(std::size_t parameter) const { return ranges_[parameter]; }

  constexpr ParameterValues presets() const {
    ParameterValues values{};
    for (std::size_t i = 0; i < parameter_count; ++i) {
      values[i] = ranges_[i].preset;
    }
    return values;
  }

  constexpr bool allows(const ParameterValues& values) const {
    for (std::size_t i = 0; i < parameter_count; ++i) {
      if (!ranges_[i].allows(values[i])) {
        return false;
      }
    }
    return true;
  }

  /// Tells this design from others, in the store.
  constexpr std::uint32_t design() const { return design_; }

  /// See link::Quantity.
  constexpr const link::FullScales& full_scales() const { return full_scales_; }

  /// Carrier periods for which the host may be silent, rounded up; 0: for ever.
  constexpr std::uint32_t timeout_periods(const ParameterValues& values) const {
    return periods(value(values, Parameter::host_timeout));
  }

  /// Carrier periods that a save may take: 10 s.
  constexpr std::uint32_t save_periods() const { return periods(longest_save_ms); }

  /// Carrier periods in which the service comes round: 50 ms.
  constexpr std::uint32_t service_periods() const { return periods(longest_service_ms); }

  /// See Controller::settle_at.
  constexpr const Designed& designed() const { return designed_; }

  /// The designed controller; where nothing was changed, bit for bit.
  constexpr typename Controller::Parameters controller_parameters(
      const ParameterValues& values) const {
    typename Controller::Parameters result{
        designed_.friction_force, designed_.smallest_friction,
        designed_.speed_floor,    designed_.lead,
        designed_.friction,       designed_.feedforward,
        designed_.slew,           designed_.shaper,
        designed_.regulator,      designed_.relearning,
        designed_.vibration,      designed_.standstill,
        designed_.stuck,          designed_.plausibility,
        designed_.watch,          {control::FullDrive<Scalar>::highest()},
        samples(values),          designed_.target};
    if (changed(values, Parameter::drive_limit)) {
      result.ceiling.highest =
          fraction_below<Scalar>(value(values, Parameter::drive_limit), one_in_millionths);
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
    if constexpr (PartsT::Force::present) {
      result.stuck.periods = static_cast<std::uint16_t>(value(values, Parameter::stuck_periods));
    }
    return result;
  }

  /// Of the force sensor; where nothing was changed, it changes no bit.
  constexpr Calibration calibration(const ParameterValues& values) const {
    return Calibration::of(value(values, Parameter::force_offset),
                           value(values, Parameter::force_gain));
  }

  /// A target in millionths as controllers take it; the designed one exactly.
  constexpr Scalar target(std::uint32_t millionths) const {
    return millionths == ranges_[static_cast<std::size_t>(Parameter::target)].preset
               ? target_
               : fraction<Scalar>(millionths, target_base * one_in_millionths);
  }

 private:
  static constexpr bool reads_force = PartsT::Force::present;
  static constexpr std::uint32_t largest_offset = reads_force ? one_in_millionths / 4 : 0;
  static constexpr std::uint32_t lowest_gain =
      reads_force ? one_in_millionths / 2 : one_in_millionths;
  static constexpr std::uint32_t highest_gain =
      reads_force ? 3 * one_in_millionths / 2 : one_in_millionths;
  static constexpr std::uint32_t target_base = PartsT::Target::base;
  static constexpr std::uint32_t longest_timeout_ms = 60'000;
  static constexpr std::uint32_t longest_save_ms = 10'000;
  static constexpr std::uint32_t longest_service_ms = 50;
  static constexpr std::uint32_t one_in_fraction = 1U << 16;

  /// Rounded up.
  constexpr std::uint32_t periods(std::uint32_t time_ms) const {
    const std::uint64_t periods = std::uint64_t{time_ms} * periods_per_ms_;
    return static_cast<std::uint32_t>((periods + one_in_fraction - 1) / one_in_fraction);
  }

  static constexpr std::uint32_t millionths(double value) {
    return numeric::round_half_up<std::uint32_t>(value * one_in_millionths);
  }

  /// The first millionth above the least that control::FrictionLevel accepts.
  static constexpr std::uint32_t smallest_friction() {
    const double least = numeric::to_real(control::FrictionLevel<Scalar>::smallest());
    return static_cast<std::uint32_t>(least * one_in_millionths) + 1;
  }

  static constexpr bool tolerates_samples = std::is_same_v<Samples, control::TolerantSamples>;

  /// Nothing to choose where no force is read.
  template <class StuckParameters>
  static constexpr ParameterRange stuck_range(const StuckParameters& stuck) {
    if constexpr (PartsT::Force::present) {
      return {Inheritance::none, stuck.periods, UINT16_MAX, stuck.periods};
    } else {
      return {Inheritance::none, 0, 0, 0};
    }
  }

  static constexpr typename Samples::Parameters samples(const ParameterValues& values) {
    if constexpr (tolerates_samples) {
      return {static_cast<std::uint8_t>(value(values, Parameter::bad_samples)), sample_window};
    } else {
      return {};
    }
  }

  static constexpr std::uint32_t value(const ParameterValues& values, Parameter parameter) {
    return values[static_cast<std::size_t>(parameter)];
  }

  static constexpr Scalar millionths_of(const ParameterValues& values, Parameter parameter) {
    return fraction<Scalar>(value(values, parameter), one_in_millionths);
  }

  constexpr bool changed(const ParameterValues& values, Parameter parameter) const {
    return value(values, parameter) != ranges_[static_cast<std::size_t>(parameter)].preset;
  }

  Designed designed_;
  ParameterRanges ranges_;
  Scalar target_;
  std::uint32_t design_;
  link::FullScales full_scales_;
  std::uint32_t periods_per_ms_;  ///< of the loop, with 16 fraction bits
};

}  // namespace sonoglide::app
