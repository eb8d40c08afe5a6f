/// The figures of the paper, by number.
#pragma once

#include <string>
#include <vector>

#include "host_sim/output/page.hpp"

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
  std::string svg;
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

}  // namespace sonoglide::paper
