/// The plant's compositions under test, and a run over whole carrier periods.
#pragma once

#include "firmware/friction/coulomb.hpp"
#include "firmware/friction/dahl.hpp"
#include "firmware/friction/none.hpp"
#include "firmware/plant/account.hpp"
#include "firmware/plant/drive.hpp"
#include "firmware/plant/model.hpp"
#include "firmware/plant/rk4/rk4.hpp"
#include "firmware/plant/solver.hpp"
#include "firmware/plant/taylor/event_taylor.hpp"
#include "tests/common/constants/pi.hpp"
#include "tests/firmware/plant/runs/case.hpp"
#include "tests/firmware/plant/runs/course.hpp"

namespace sonoglide::plant {

using tests::pi;

template <class Scalar>
using DahlModel = Model<friction::Dahl<Scalar>, Undamped<Scalar>, CosineDrive>;
template <class Scalar>
using DampedDahlModel = Model<friction::Dahl<Scalar>, Damped<Scalar>, CosineDrive>;
template <class Scalar>
using CoulombModel = Model<friction::Coulomb<Scalar>, Undamped<Scalar>, CosineDrive>;
template <class Scalar>
using DampedCoulombModel = Model<friction::Coulomb<Scalar>, Damped<Scalar>, CosineDrive>;

template <class Solver>
Solver configured(const typename Solver::Model& model, typename Solver::Scalar setting) {
  Solver solver;
  solver.configure(model, setting);
  return solver;
}

template <class Solver>
using StateFor = typename Solver::Model::PlantState;

template <class Solver, class Account>
Outcome<typename Solver::Scalar> advance(Solver& solver,
                                         const IntervalOf<typename Solver::Model>& interval,
                                         StateFor<Solver>& state, Account& account) {
  NoObserver observer;
  return solver.advance(interval, state, account, observer);
}

template <class Solver>
StateFor<Solver> advanced(Solver& solver, const IntervalOf<typename Solver::Model>& interval,
                          StateFor<Solver> state) {
  NoAccount account;
  advance(solver, interval, state, account);
  return state;
}

/// Whole carrier periods from drive phase 0; stops at the first error.
template <class Solver, class Account>
Error run_periods(Solver& solver, int periods, typename Solver::Scalar drive_amplitude,
                  typename Solver::Scalar sliding_velocity, StateFor<Solver>& state,
                  Account& account) {
  const auto wide = [](auto x) { return static_cast<double>(x); };
  const Interval<typename Solver::Scalar> period =
      lasting(2.0 * pi).driven(wide(drive_amplitude)).sliding(wide(sliding_velocity));
  for (int i = 0; i < periods; ++i) {
    const Error error = advance(solver, period, state, account).error;
    if (error != Error::none) {
      return error;
    }
  }
  return Error::none;
}

}  // namespace sonoglide::plant
