/// A scene that names a drive and a contact: the same reading finds them, where they are.

#include "tests/firmware/plant/runs/motion.hpp"

namespace sonoglide::plant {

State<double> driven_dahl_period(EventTaylor<DahlModel<double>, 16>& solver,
                                 const State<double>& state) {
  return advanced(solver, lasting(2.0 * pi).driven(1.0).sliding(0.5), state);
}

}  // namespace sonoglide::plant
