/// The same for a sliding that changes: what only it has a use for is found by the same reading.

#include "firmware/plant/model.hpp"
#include "tests/firmware/plant/runs/motion.hpp"

namespace sonoglide::plant {

using Plant = Model<friction::Dahl<double>, Undamped<double>, CosineDrive, LinearSliding>;

Outcome<double> linear_sliding_period(EventTaylor<Plant, 16>& solver, State<double>& state,
                                      EnergyAccount<double>& account) {
  return advance(solver, lasting(2.0 * pi).driven(1.0).sliding(0.5).accelerating(0.1), state,
                 account);
}

}  // namespace sonoglide::plant
