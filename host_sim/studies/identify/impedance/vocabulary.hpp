/// The words that the headings of sweeps are made of.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace sonoglide::identify::impedance {

enum class Role { none, frequency, magnitude, phase, real, imaginary };
/// A reflection is that of a Touchstone file.
enum class Subject { unknown, impedance, admittance, reflection };

struct Meaning {
  Role role;
  Subject subject;
};

/// Of a word, whose case does not matter: `freq`, `Z`, `theta`, `reactance`, and a part with its z or
/// y in one word, as `absz` and `Zphase`. Nothing: it is no word of a sweep.
std::optional<Meaning> meaning_of(std::string_view word);

/// A word that says nothing, as `data` or `of`. In small letters, as all below.
bool is_filler(std::string_view word);

/// Whether a word names an element of an equivalent circuit, or its quality, that an analyser shows
/// instead of an impedance: cp, cs, lp, ls, rp, q, d.
bool is_equivalent_element(std::string_view word);

/// Whether a name is of a reflection, a transmission or a gain, whose phase may stand beside it: S11,
/// return loss …
bool is_of_ratio(std::string_view name);

/// Whether a name is of such a ratio or of an element of an equivalent circuit.
bool is_of_other_quantity(std::string_view name);

/// With English for the words of other scripts: 频率, 阻抗, 相位 …
std::string translated(std::string_view text);

}  // namespace sonoglide::identify::impedance
