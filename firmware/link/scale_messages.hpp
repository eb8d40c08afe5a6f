/// The messages by which a unit tells what its numbers are in SI units.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/link/payload.hpp"

namespace sonoglide::link {

/// What a unit reads, answers or takes as a part of a full scale.
enum class Quantity : std::uint8_t {
  friction_force,    ///< codes
  sliding_velocity,  ///< codes
  amplitude,         ///< of the drive, codes
  target,            ///< millionths
  bias,              ///< codes
  step,  ///< of the controller, a count of them: full scale is the time from one to the next
};
inline constexpr std::size_t quantity_count = 6;

/// In which a full scale is told.
enum class ScaleUnit : std::uint8_t {
  none,  ///< the unit has no such quantity
  ratio,
  newton,
  metre_per_second,
  volt,
  second,
};

/// What a code of 2^31, a million millionths or one step stands for.
struct FullScale {
  ScaleUnit unit;
  double value;  ///< above 0; 0 where there is no unit
};

/// In the order of Quantity; constants of a design.
using FullScales = std::array<FullScale, quantity_count>;

/// Asks for Scale.
struct ReadScale {
  static constexpr std::uint8_t kind = 0x0F;
  std::uint8_t quantity;  ///< Quantity

  template <class Message, class Visitor>
  static constexpr void fields(Message& message, Visitor&& visit) {
    visit(message.quantity);
  }
};

/// A full scale. As a double, so that a code times it is the number that a simulation has, to the last bit.
struct Scale {
  static constexpr std::uint8_t kind = ReadScale::kind | answer_bit;
  std::uint8_t quantity;
  std::uint8_t unit;          ///< ScaleUnit
  std::uint32_t lower_word;   ///< of the full scale, a double of IEEE 754
  std::uint32_t higher_word;  ///< likewise

  template <class Message, class Visitor>
  static constexpr void fields(Message& message, Visitor&& visit) {
    visit(message.quantity);
    visit(message.unit);
    visit(message.lower_word);
    visit(message.higher_word);
  }
};

constexpr Scale scale_of(std::uint8_t quantity, const FullScale& told) {
  const auto bits = __builtin_bit_cast(std::uint64_t, told.value);
  return {quantity, static_cast<std::uint8_t>(told.unit), static_cast<std::uint32_t>(bits),
          static_cast<std::uint32_t>(bits >> 32)};
}

constexpr FullScale full_scale_of(const Scale& told) {
  const std::uint64_t bits = std::uint64_t{told.higher_word} << 32 | told.lower_word;
  return {static_cast<ScaleUnit>(told.unit), __builtin_bit_cast(double, bits)};
}

}  // namespace sonoglide::link
