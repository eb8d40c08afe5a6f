/// The smallest scene there is; what its loop refers to is read from the object file.

#include "tests/firmware/plant/runs/motion.hpp"

namespace sonoglide::plant {

using FreeOscillator = Model<friction::None<double>, Undamped<double>, NoDrive>;

State<double> free_oscillator_period(EventTaylor<FreeOscillator, 16>& solver,
                                     const State<double>& state) {
  return advanced(solver, lasting(2.0 * pi), state);
}

}  // namespace sonoglide::plant
