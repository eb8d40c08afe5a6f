/// How often the 95 % intervals of an identification hold the truth.
#pragma once

#include <string>
#include <vector>

#include "synthetic.hpp"

namespace sonoglide::identify::impedance {

inline constexpr Kind kinds[] = {
    {"complex_relative", true, Error::relative, 0.0, Second::none},
    {"complex_admittance", true, Error::admittance, 0.0, Second::none},
    {"complex_impedance", true, Error::impedance, 0.0, Second::none},
    {"complex_loss", true, Error::relative, 0.02, Second::none},
    {"complex_second_mode", true, Error::relative, 0.0, Second::strong},
    {"complex_correlated", true, Error::correlated, 0.0, Second::none},
    {"complex_misfit", true, Error::relative, 0.0, Second::weak},
    {"complex_softening", true, Error::relative, 0.0, Second::none, Trait::lean},
    {"complex_phase_error", true, Error::relative, 0.0, Second::none, Trait::phase_error},
    {"complex_narrow_phase_error", true, Error::relative, 0.0, Second::none, Trait::narrow},
    {"complex_delay", true, Error::relative, 0.0, Second::none, Trait::delay},
    {"complex_wide_delay", true, Error::relative, 0.0, Second::none, Trait::wide_delay},
    {"complex_lead_delay", true, Error::relative, 0.0, Second::none, Trait::lead_delay},
    {"complex_lead", true, Error::relative, 0.0, Second::none, Trait::lead},
    {"complex_mode_beside", true, Error::relative, 0.0, Second::beside},
    {"complex_jitter", true, Error::jitter, 0.0, Second::none},
    {"complex_drift", true, Error::relative, 0.0, Second::none, Trait::drift},
    {"magnitude_relative", false, Error::relative, 0.0, Second::none},
    {"magnitude_admittance", false, Error::admittance, 0.0, Second::none},
    {"magnitude_second_mode", false, Error::relative, 0.0, Second::strong},
    {"magnitude_correlated", false, Error::correlated, 0.0, Second::none},
    {"magnitude_misfit", false, Error::relative, 0.0, Second::weak},
    {"magnitude_softening", false, Error::relative, 0.0, Second::none, Trait::lean},
};

/// Of each kind in coverage.csv.
inline constexpr int recorded_sweeps = 300;

struct Coverage {
  std::string parameter;
  int sweeps = 0;
  int covered = 0;
  int told = 0;  ///< sweeps of which a sentence names what is not in the interval
  int told_and_covered = 0;
};

/// Of the eight parameters of the contract, over so many random sweeps; a refused sweep covers
/// nothing.
std::vector<Coverage> coverage(const Kind& kind, int sweeps, unsigned seed);

}  // namespace sonoglide::identify::impedance
