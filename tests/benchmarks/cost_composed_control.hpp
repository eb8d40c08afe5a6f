/// The closed loop at Table 1, composed as the product composes it.
#pragma once

#include <cstdint>

#include "cost_composed.hpp"
#include "firmware/app/control_loop.hpp"
#include "firmware/control/controller.hpp"
#include "firmware/control/feedback/integral_regulator.hpp"
#include "firmware/control/friction/dahl_feedforward.hpp"
#include "firmware/control/friction/learnt_friction.hpp"
#include "firmware/control/limits/notch_shaper.hpp"
#include "firmware/control/limits/slew_limit.hpp"
#include "hal/host/simulated_board.hpp"

namespace sonoglide::cost {

template <class Number>
using ControllerOf = control::Controller<
    control::Parts<Number, control::TrustedFriction<Number>, control::DahlFeedforward<Number>,
                   control::NoSlewLimit<Number>, control::NotchShaper<Number, 1>,
                   control::IntegralRegulator<Number, 1>>>;

template <class Number>
ControllerOf<Number> controller_of(const ControlNumbers& numbers) {
  const auto number = [](double value) { return numeric::from_real<Number>(value); };
  const numeric::Split<double> contact = numeric::split(numbers.contact_force);
  typename ControllerOf<Number>::Parameters parameters{};
  parameters.friction_force = number(numbers.friction_force);
  parameters.speed_floor = number(numbers.speed_floor);
  parameters.lead = number(numbers.lead_periods / 64.0);
  parameters.feedforward = {{number(contact.mantissa), contact.exponent}};
  parameters.shaper = {
      {number(numbers.outer_tap), number(numbers.middle_tap), number(numbers.outer_tap)}, 1};
  parameters.smallest_friction = control::FrictionLevel<Number>::smallest();
  parameters.regulator = {number(numbers.gain), Number{}, numbers.hold_periods,
                          numbers.rest_periods, 1};
  parameters.standstill = {numbers.standstill_periods, number(numbers.standstill_fall)};
  parameters.stuck = {numbers.stuck_periods};
  parameters.plausibility = {numbers.implausible_periods};
  parameters.watch = {number(numbers.settling_band), numbers.patience_periods,
                      number(numbers.agreement)};
  ControllerOf<Number> controller(parameters);
  controller.start();
  controller.set_target(number(0.5 * numbers.target_friction_ratio));
  return controller;
}

template <class Solver, class Number>
Result run_controlled(const Scene& scene) {
  using Controller = ControllerOf<Number>;
  Controller controller = controller_of<Number>(control_numbers);
  hal::host::SimulatedBoard<> board;
  app::ControlLoop<Controller, hal::host::SimulatedBoard<>> loop(controller, board);
  Solver solver;
  solver.configure(model_of(scene, typename Solver::Model()), tolerance);
  plant::Interval<double> period = {0.0, two_pi, 0.0, scene.sliding_velocity, 0.0};
  plant::State<double> state = {initial_displacement, 0.0, 0.0};
  plant::NoObserver observer;
  plant::MeanFriction<double> account;
  double integral = 0.0;
  for (int i = 0; i < periods; ++i) {
    if (solver.advance(period, state, account, observer).error != plant::Error::none) {
      return {};
    }
    const double mean = (account.friction_integral - integral) / two_pi;
    integral = account.friction_integral;
    hal::Sample sample{};
    sample.friction_force = numeric::to_code(0.5 * mean);
    sample.sliding_velocity = numeric::to_code(control_numbers.speed);
    sample.fresh = true;
    board.post(sample);
    loop.serve();
    period.drive_amplitude = control_numbers.full_drive_amplitude *
                             numeric::from_code<double>(board.latest_drive().amplitude);
  }
  Result result;
  result.displacement = state.displacement;
  result.velocity = state.velocity;
  result.friction = state.friction;
  result.friction_integral = account.friction_integral;
  result.drive_amplitude = period.drive_amplitude;
  result.steps = solver.cost().steps;
  return result;
}

}  // namespace sonoglide::cost
