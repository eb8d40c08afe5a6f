/// The figures of the paper, by number.
#pragma once

#include <vector>

#include "host_sim/studies/paper/figure.hpp"

namespace sonoglide::paper {

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
