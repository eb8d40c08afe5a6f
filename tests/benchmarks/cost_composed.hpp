/// A run over a scene of the cost ladder, composed as the product composes it.
#pragma once

#include <type_traits>

#include "cost_scene.hpp"
#include "firmware/friction/coulomb.hpp"
#include "firmware/friction/dahl.hpp"
#include "firmware/friction/none.hpp"
#include "firmware/plant/account.hpp"
#include "firmware/plant/drive.hpp"
#include "firmware/plant/model.hpp"
#include "firmware/plant/rk4/rk4.hpp"
#include "firmware/plant/solver.hpp"
#include "firmware/plant/taylor/event_taylor.hpp"

namespace sonoglide::cost {

template <class Model>
using Taylor = plant::EventTaylor<Model, 16>;

using Free = friction::None<double>;
using Coulomb = friction::Coulomb<double>;
using Dahl = friction::Dahl<double>;
using Undamped = plant::Undamped<double>;
using Damped = plant::Damped<double>;
using plant::CosineDrive;
using plant::NoDrive;

inline void fill(const Scene& /*scene*/, plant::Contact<Free>& /*contact*/) {}
inline void fill(const Scene& scene, plant::Contact<Coulomb>& contact) {
  contact.friction_force = scene.friction_force;
}
inline void fill(const Scene& scene, plant::Contact<Dahl>& contact) {
  contact.friction_force = scene.friction_force;
  contact.law.contact_stiffness = scene.contact_stiffness;
}
inline void fill(const Scene& /*scene*/, Undamped& /*damping*/) {}
inline void fill(const Scene& scene, Damped& damping) {
  damping.damping = scene.damping;
}

template <class Law, class Damping, class Drive>
plant::Model<Law, Damping, Drive, plant::ConstantSliding> model_of(
    const Scene& scene, const plant::Model<Law, Damping, Drive, plant::ConstantSliding>& /*type*/) {
  plant::Model<Law, Damping, Drive, plant::ConstantSliding> model;
  fill(scene, static_cast<plant::Contact<Law>&>(model));
  fill(scene, static_cast<Damping&>(model));
  model.stiffness = scene.stiffness;
  return model;
}

template <class Solver>
double precision_of() {
  return std::is_same_v<Solver, Taylor<typename Solver::Model>> ? tolerance : fixed_step;
}

/// Records the displacement at equal times; begins afresh with each period.
class DisplacementRecorder {
 public:
  explicit DisplacementRecorder(double* record) : record_(record) {}

  void begin_period() { sample_ = 0; }

  template <class Step>
  void operator()(const Step& step) {
    const double end = step.begin() + step.length();
    for (; sample_ < samples_per_period && sample_ * sample_spacing <= end; ++sample_) {
      *record_++ = step.at(sample_ * sample_spacing - step.begin()).displacement;
    }
  }

 private:
  double* record_;
  int sample_ = 0;
};

inline void begin_period(plant::NoObserver& /*observer*/) {}
inline void begin_period(DisplacementRecorder& observer) {
  observer.begin_period();
}

inline void copy(const plant::NoAccount& /*account*/, Result& /*result*/) {}
inline void copy(const plant::MeanFriction<double>& account, Result& result) {
  result.friction_integral = account.friction_integral;
}
inline void copy(const plant::EnergyAccount<double>& account, Result& result) {
  result.friction_integral = account.friction_integral;
  result.friction_work = account.friction_work;
  result.sliding_work = account.sliding_work;
  result.drive_work = account.drive_work;
  result.damping_work = account.damping_work;
  result.velocity_square = account.velocity_square;
  result.displacement_square = account.displacement_square;
}

template <class Solver, class Account, class Observer>
Result run_watched(const Scene& scene, Observer observer) {
  Solver solver;
  solver.configure(model_of(scene, typename Solver::Model()), precision_of<Solver>());
  const plant::Interval<double> period = {0.0, two_pi, scene.drive_amplitude,
                                          scene.sliding_velocity, 0.0};
  plant::State<double> state = {initial_displacement, 0.0, 0.0};
  Account account;
  for (int i = 0; i < periods; ++i) {
    begin_period(observer);
    if (solver.advance(period, state, account, observer).error != plant::Error::none) {
      return {};
    }
  }
  Result result;
  result.displacement = state.displacement;
  result.velocity = state.velocity;
  result.friction = state.friction;
  result.steps = solver.cost().steps;
  copy(account, result);
  return result;
}

template <class Solver, class Account>
Result run(const Scene& scene) {
  return run_watched<Solver, Account>(scene, plant::NoObserver());
}

template <class Solver, class Account>
Result run_recorded(const Scene& scene, double* record) {
  return run_watched<Solver, Account>(scene, DisplacementRecorder(record));
}

}  // namespace sonoglide::cost
