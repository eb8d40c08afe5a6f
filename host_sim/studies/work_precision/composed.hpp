/// A solver of the product as a contender: composed by types, as everywhere else.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>

#include "firmware/friction/dahl.hpp"
#include "firmware/plant/account.hpp"
#include "firmware/plant/damping.hpp"
#include "firmware/plant/drive.hpp"
#include "firmware/plant/model.hpp"
#include "firmware/plant/observer.hpp"
#include "firmware/plant/outcome.hpp"
#include "firmware/plant/sliding.hpp"
#include "firmware/plant/state.hpp"
#include "host_sim/studies/work_precision/peers/contender.hpp"
#include "host_sim/studies/work_precision/peers/problem.hpp"

namespace sonoglide::work_precision {

/// What a failed advance shows as its status.
std::string status_of(plant::Error error);

template <class Solver>
class Composed final : public peers::Contender {
 public:
  using Model = typename Solver::Model;
  using Scalar = typename Solver::Scalar;

  Composed(const peers::Problem& problem, const Model& model, double setting)
      : model_(model),
        setting_(static_cast<Scalar>(setting)),
        initial_{static_cast<Scalar>(problem.displacement), static_cast<Scalar>(problem.velocity),
                 static_cast<Scalar>(problem.friction)},
        period_{Scalar(0), static_cast<Scalar>(peers::carrier_period),
                static_cast<Scalar>(problem.drive_amplitude),
                static_cast<Scalar>(problem.sliding_velocity), Scalar(0)} {}

  void restart() override {
    solver_.configure(model_, setting_);
    state_ = initial_;
    integral_ = 0.0;
  }

  std::string advance(int periods) override {
    plant::NoObserver nobody;
    for (int i = 0; i < periods; ++i) {
      plant::MeanFriction<Scalar> account;
      const plant::Error error = solver_.advance(period_, state_, account, nobody).error;
      integral_ += static_cast<double>(account.friction_integral);
      if (error != plant::Error::none) {
        return status_of(error);
      }
    }
    return {};
  }

  double friction_integral() const override { return integral_; }
  std::uint64_t steps() const override { return solver_.cost().steps; }

 private:
  Model model_;
  Scalar setting_;
  plant::State<Scalar> initial_;
  plant::Interval<Scalar> period_;
  Solver solver_;
  plant::State<Scalar> state_;
  double integral_ = 0.0;
};

/// The problem's model with this damping, in this arithmetic.
template <class Scalar>
plant::Contact<friction::Dahl<Scalar>> contact_of(const peers::Problem& problem) {
  return {{static_cast<Scalar>(problem.contact_stiffness)},
          static_cast<Scalar>(problem.friction_force),
          static_cast<Scalar>(problem.vibration_sign)};
}

/// @tparam Solver   a solver template over the model
/// @param  setting  what its configure() takes: a tolerance, or the longest step in tau
/// The plant has no damping term where the problem has no damping; in float it always has one.
template <template <class> class Solver, class Scalar>
std::unique_ptr<peers::Contender> compose(const peers::Problem& problem, double setting) {
  const auto stiffness = static_cast<Scalar>(problem.stiffness);
  if constexpr (std::is_same_v<Scalar, double>) {
    if (!(problem.damping > 0.0)) {
      using Model = plant::Model<friction::Dahl<Scalar>, plant::Undamped<Scalar>,
                                 plant::CosineDrive, plant::ConstantSliding>;
      return std::make_unique<Composed<Solver<Model>>>(
          problem, Model{contact_of<Scalar>(problem), {}, stiffness}, setting);
    }
  }
  using Model = plant::Model<friction::Dahl<Scalar>, plant::Damped<Scalar>, plant::CosineDrive,
                             plant::ConstantSliding>;
  return std::make_unique<Composed<Solver<Model>>>(
      problem,
      Model{contact_of<Scalar>(problem), {static_cast<Scalar>(problem.damping)}, stiffness},
      setting);
}

}  // namespace sonoglide::work_precision
