/// What the paper's energy balance and its faults come to, measured.
#pragma once

#include <string>
#include <vector>

#include "host_sim/scene/scene.hpp"

namespace sonoglide::paper {

/// The balances of one carrier period. Energies in J; E as the paper defines it.
struct Balance {
  std::string start;  ///< "from_rest", of which it is the last of 100 periods; or "steady"
  double velocity_ratio;
  double kinetic_sliding;            ///< m Vt²/2, of (4)
  double undriven;                   ///< Ef = Fn Vt T, of (4)
  double input_undriven;             ///< Ei, (3) and (4): the sum of both
  double ultrasonic_input;           ///< Eiu, (12)
  double input;                      ///< Einput, (5)
  double average_kinetic;            ///< Eku, (6)
  double average_potential;          ///< Epu, (7)
  double dissipated;                 ///< Efu, (8)
  double average_stored;             ///< Esu, (11)
  double pull;                       ///< ∫F Vt dt: what keeps up the sliding; Fn Vt T in print
  double stored_change;              ///< of m x'²/2 + Ks x²/2
  double printed_dissipation_ratio;  ///< φfu = 1 + φiu − φsu, (16)
  double true_dissipation_ratio;     ///< Efu/Ef
  double printed_residual;  ///< of (9), (10) and, divided by Ef, (13) to (16): relative to the
                            ///< largest term of (10)
  double true_residual;     ///< of Efu = pull + Eiu − stored_change, relative to its largest term
};

/// On the steady orbit.
Balance steady_balance(const scene::Scene& scene, double velocity_ratio);
/// The same of Table 1 at 384 N.
Balance steady_balance(double velocity_ratio);

/// The same, from rest and on the steady orbit, at several velocity ratios.
std::vector<Balance> balances();

/// `start,velocity_ratio,equation,quantity,value`, one line for each quantity.
std::string balance_csv(const std::vector<Balance>& balances);

struct PrintedFault {
  std::string in_print;
  std::string effect;  ///< measured
  std::string here;
};

std::vector<PrintedFault> faults();

}  // namespace sonoglide::paper
