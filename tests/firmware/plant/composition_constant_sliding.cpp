/// The energy account of a contact that slides at one velocity.

#include "firmware/plant/model.hpp"
#include "tests/firmware/plant/runs/motion.hpp"

namespace sonoglide::plant {

using Plant = Model<friction::Dahl<double>, Undamped<double>, CosineDrive, ConstantSliding>;

Outcome<double> constant_sliding_period(EventTaylor<Plant, 16>& solver, State<double>& state,
                                        EnergyAccount<double>& account) {
  return advance(solver, lasting(2.0 * pi).driven(1.0).sliding(0.5), state, account);
}

}  // namespace sonoglide::plant
