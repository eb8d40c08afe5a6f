/// The samples of the how-tos: a law and a solver made by following them do what they should.

#include <gtest/gtest.h>

#include <cmath>

#include "firmware/friction/law.hpp"
#include "firmware/plant/solver.hpp"
#include "samples/explicit_euler.hpp"
#include "samples/viscous.hpp"
#include "tests/firmware/plant/runs/motion.hpp"

namespace sonoglide::plant::samples_test {
namespace {

using FilmModel = Model<friction::Viscous<double>, Undamped<double>, NoDrive>;
using DampedModel = Model<friction::None<double>, Damped<double>, NoDrive>;

static_assert(friction::check_law<friction::Viscous<double>>());
static_assert(check_solver<ExplicitEuler<FilmModel>>());

constexpr double film_coefficient = 0.3;  // c
constexpr double friction_force = 0.2;    // beta
constexpr double stiffness = 1.7;

/// Without sliding the film is a damper with d = beta c.
const FilmModel film_model{{{film_coefficient}, friction_force, 1.0}, {}, stiffness};
const DampedModel damped_model{{}, {friction_force * film_coefficient}, stiffness};

template <class Solver>
State<double> after_two_periods(const typename Solver::Model& model, double setting) {
  Solver solver = configured<Solver>(model, setting);
  StateFor<Solver> state;
  state.displacement = 1.0;
  NoAccount account;
  EXPECT_EQ(run_periods(solver, 2, 0.0, 0.0, state, account), Error::none);
  return state;
}

TEST(SampleLaw, OfAViscousFilmIsADamper) {
  const auto film = after_two_periods<EventTaylor<FilmModel, 16>>(film_model, 1e-12);
  const auto damped = after_two_periods<EventTaylor<DampedModel, 16>>(damped_model, 1e-12);
  EXPECT_NEAR(film.displacement, damped.displacement, 1e-10);
  EXPECT_NEAR(film.velocity, damped.velocity, 1e-10);
}

TEST(SampleSolver, IsOfFirstOrder) {
  const auto exact = after_two_periods<EventTaylor<FilmModel, 16>>(film_model, 1e-12);
  const auto error = [&](double step) {
    const auto state = after_two_periods<ExplicitEuler<FilmModel>>(film_model, step);
    return std::abs(state.displacement - exact.displacement);
  };
  const double coarse = error(1e-3);
  const double fine = error(5e-4);
  EXPECT_GT(coarse, 1e-4);
  EXPECT_NEAR(coarse / fine, 2.0, 0.02);
}

}  // namespace
}  // namespace sonoglide::plant::samples_test
