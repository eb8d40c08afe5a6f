/// The figures of the paper, by number.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host_sim/output/page.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::paper {

enum class ClaimStatus { holds, does_not_hold, depends };

/// What the paper says, and what the numbers say of it.
struct Claim {
  std::string statement;
  ClaimStatus verdict;
  std::string numbers;
};

/// Beside the figure's own CSV and SVG.
struct File {
  std::string name;
  std::string text;
};

struct Figure {
  int number;
  std::string title;
  std::string conditions;  ///< parameters, initial state and averaging window
  std::string command;     ///< that computes the same with table_1.toml
  std::string csv;
  std::vector<output::Chart> charts;
  std::vector<Claim> claims;
  std::vector<output::Table> tables = {};
  std::vector<File> files = {};
};

inline ClaimStatus verdict(bool holds) {
  return holds ? ClaimStatus::holds : ClaimStatus::does_not_hold;
}

/// Each computes what it shows. @throws process::ProcessError, loop::ComputationError
Figure figure_2();   ///< friction ratio over velocity ratio, Coulomb and Dahl
Figure figure_3();   ///< friction force over time, Coulomb and Dahl
Figure figure_4();   ///< displacement and velocity over time
Figure figure_5();   ///< friction force and dissipated power over time
Figure figure_6();   ///< spectra of velocity and friction force
Figure figure_7();   ///< effect of the control force
Figure figure_8();   ///< of the coefficient of friction
Figure figure_9();   ///< of the mass
Figure figure_10();  ///< of the contact stiffness
Figure figure_11();  ///< of the system stiffness
Figure figure_12();  ///< the laws against each other and against published measurements

struct NumberedFigure {
  int number;
  Figure (*compute)();
};

const std::vector<NumberedFigure>& figure_list();

// What the paper's energy balance and its faults come to, measured.

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

/// What the introduction says of dither against squeal, on a mass on a belt.
std::vector<Claim> dither_claims();

// The paper's figures and balance as data, pictures and one page.

/// What is no figure.
struct Findings {
  std::vector<PrintedFault> faults;
  std::vector<Balance> balances;
  std::vector<Claim> dither;
};

/// @param findings  left out where empty
output::Page paper_page(const std::vector<Figure>& figures, const Findings& findings);

using Progress = std::function<void(double fraction)>;

/// Writes of each figure figure_NN.csv, figure_NN.svg and whatever else it has, balance.csv,
/// table_1.toml, table_2.toml and index.html; of one figure alone its own files, the two scenes and
/// the page.
/// @param figure  one of figure_list(); absent: all of them, and the balance
/// @throws process::FileError, process::ProcessError, loop::ComputationError; nothing is written
/// then
void write_paper(const std::filesystem::path& out, std::optional<int> figure,
                 const Progress& progress);

}  // namespace sonoglide::paper
