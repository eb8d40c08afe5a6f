/// A solver of the product as a contender: composed by types, as everywhere else.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "firmware/friction/dahl.hpp"
#include "firmware/plant/account.hpp"
#include "firmware/plant/contact.hpp"
#include "firmware/plant/drive.hpp"
#include "firmware/plant/model.hpp"
#include "firmware/plant/outcome.hpp"
#include "firmware/plant/solver.hpp"
#include "firmware/plant/state.hpp"
#include "firmware/plant/stiff/stiff_linear.hpp"
#include "firmware/plant/taylor/event_taylor.hpp"  // that every solver may hand turns to
#include "host_sim/configure/plant_model.hpp"
#include "host_sim/scene/solver_methods.hpp"
#include "host_sim/studies/work_precision/peers/contender.hpp"
#include "host_sim/studies/work_precision/settings.hpp"
#include "host_sim/studies/work_precision/solvers.hpp"

namespace sonoglide::work_precision {

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
template <class Scalar, template <class> class Damping>
auto model_of(const peers::Problem& problem) {
  const plant::Contact<friction::Dahl<Scalar>> contact = {
      {static_cast<Scalar>(problem.contact_stiffness)},
      static_cast<Scalar>(problem.friction_force),
      static_cast<Scalar>(problem.vibration_sign)};
  return configure::plant_model<Scalar, Damping, plant::CosineDrive, plant::ConstantSliding>(
      contact,
      {problem.stiffness, problem.damping, problem.friction_force, problem.contact_stiffness});
}

template <template <class> class Solver, class Model>
std::unique_ptr<peers::Contender> contender_of(const peers::Problem& problem, const Model& model,
                                               double setting) {
  return std::make_unique<Composed<Solver<Model>>>(problem, model, setting);
}

/// @tparam Solver   a solver template over the model
/// @param  setting  what its configure() takes: a tolerance, or the longest step in tau
/// The plant has no damping term where the problem has no damping.
template <template <class> class Solver, class Scalar>
std::unique_ptr<peers::Contender> compose(const peers::Problem& problem, double setting) {
  if (!(problem.damping > 0.0)) {
    return contender_of<Solver>(problem, model_of<Scalar, plant::Undamped>(problem), setting);
  }
  return contender_of<Solver>(problem, model_of<Scalar, plant::Damped>(problem), setting);
}

namespace detail {

template <class Described, int Order>
struct OfOrder {
  template <class Model>
  using Solver = typename Described::template Core<Model, Order>;
};

template <class Described, int Order, class Scalar>
std::unique_ptr<peers::Contender> contender(const peers::Problem& problem, double setting) {
  return compose<OfOrder<Described, Order>::template Solver, Scalar>(
      problem, Described::adaptive ? setting : peers::carrier_period / setting);
}

template <class Scalar>
inline constexpr bool is_single = std::is_same_v<Scalar, float>;

template <class Described, class Scalar>
constexpr const auto& sweeps() {
  if constexpr (is_single<Scalar>) {
    return Settings<Described>::float32_sweeps;
  } else {
    return Settings<Described>::float64_sweeps;
  }
}

template <class Described, class Scalar, std::size_t Index>
ComparedSolver solver() {
  constexpr Sweep sweep = sweeps<Described, Scalar>()[Index];
  const std::string order = sweep.order > 0 ? fmt::format("_{}", sweep.order) : "";
  return {fmt::format("{}{}{}", Described::name, order, is_single<Scalar> ? "_float32" : ""),
          is_single<Scalar> ? Family::single : Settings<Described>::family,
          Described::adaptive ? Knob::tolerance : Knob::steps_per_period,
          Described::adaptive ? tolerances(sweep.first_decade, sweep.last_decade)
                              : step_counts(sweep.first_decade, sweep.last_decade),
          contender<Described, sweep.order, Scalar>};
}

template <class Described, class Scalar, std::size_t... Index>
std::vector<ComparedSolver> contenders(std::index_sequence<Index...> /*all*/) {
  return {solver<Described, Scalar, Index>()...};
}

}  // namespace detail

template <class Described, class Scalar>
std::vector<ComparedSolver> contenders() {
  return detail::contenders<Described, Scalar>(
      std::make_index_sequence<detail::sweeps<Described, Scalar>().size()>{});
}

}  // namespace sonoglide::work_precision
