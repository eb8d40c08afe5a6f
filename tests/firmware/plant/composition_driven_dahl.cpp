/// A scene that names a drive and a contact: the same reading finds them, where they are.

#include "tests/firmware/plant/runs/motion.hpp"

namespace sonoglide::plant {

State<double> driven_dahl_period(EventTaylor<DahlModel<double>, 16>& solver,
                                 const State<double>& state) {
  return advanced(solver, {0.0, 2.0 * pi, 1.0, 0.5, 0.0}, state);
}

}  // namespace sonoglide::plant
