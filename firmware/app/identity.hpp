/// What a unit says of itself to its host.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/kept_exception.hpp"

namespace sonoglide::app {

/// Of this firmware, as that of the host program.
struct Version {
  std::uint8_t major_number;
  std::uint8_t minor_number;
  std::uint8_t patch_number;
};
inline constexpr Version version{0, 1, 0};

/// A unit whose board has no name and no serial number. A product has a class of this shape in its place:
///
///   struct Product : app::Unnamed {
///     static constexpr const char* board = "rail-drive-2";  // at most link::most_name_characters
///     static std::uint32_t serial_number();                 // 0: none was given
///     static inline const hal::KeptException* exception = nullptr;  // as its main took it; null: none
///     static inline app::UnitHistory<Flash>* history = nullptr;     // set by its main
///   };
struct Unnamed {
  static constexpr const char* board = "";
  static std::uint32_t serial_number() { return 0; }
  static constexpr std::nullptr_t exception = nullptr;  ///< it keeps none
  static constexpr std::nullptr_t history = nullptr;    ///< likewise
};

/// The characters of a name, with zeros behind them; to be called at compile time, where a name that is
/// longer than `Size` does not compile.
template <std::size_t Size>
constexpr std::array<char, Size> padded(const char* name) {
  std::array<char, Size> result{};
  for (std::size_t i = 0; name[i] != '\0'; ++i) {
    result[i] = name[i];
  }
  return result;
}

}  // namespace sonoglide::app
