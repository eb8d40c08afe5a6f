/// Units in headings: the one table of them, their prefixes and powers of ten.
#pragma once

#include <optional>
#include <string_view>

namespace sonoglide::identify {

enum class Dimension { frequency, angle, impedance, admittance, level, other };

struct Unit {
  Dimension dimension;
  double scale;  ///< to Hz, rad, ohm, S; of a level 1, it is in dB
};

/// A word as `kHz`, `MOhm`, `megohm`, `uS`, `deg`, `dB`, in the spelling of plain_text(). Prefixes
/// are p n u m k M G T or their names. Case matters where it decides: `mHz` and `MS` are no units,
/// because a capital too few or too many would be a factor of 10⁹, and `mohm` is a thousandth of an
/// ohm. `mhz`, in small letters, is 10⁶ Hz. Units of other quantities (V, A, F, H, s …) have the
/// dimension `other`.
std::optional<Unit> unit_of_word(std::string_view word);

/// A whole power of ten with a unit, as stands in brackets or behind a slash: `10^3 Ohm`, `1e3 Ohm`,
/// `*10^-6 S`, `Hz`, `1/Ohm`. Nothing where a part of it is not understood.
/// @param text  in the spelling of plain_text()
std::optional<Unit> unit_of_text(std::string_view text);

/// What a message calls allowed.
std::string_view known_units();

}  // namespace sonoglide::identify
