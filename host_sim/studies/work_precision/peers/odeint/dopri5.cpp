#include "host_sim/studies/work_precision/peers/contender.hpp"

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <cmath>

namespace sonoglide::peers {
namespace {

namespace odeint = boost::numeric::odeint;

/// y, y', phi and the integral of phi.
using State = std::array<double, 4>;
using Stepper = odeint::result_of::make_controlled<odeint::runge_kutta_dopri5<State>>::type;

constexpr double first_step = 1e-3;
/// A contact that needs shorter steps than this makes no headway.
constexpr double shortest_step = 1e-12;

struct RightHandSide {
  Problem problem;

  void operator()(const State& x, State& slope, double tau) const {
    const double sliding = problem.sliding_velocity + problem.vibration_sign * x[1];
    slope[0] = x[1];
    slope[1] = problem.drive_amplitude * std::cos(tau) - problem.damping * x[1] -
               problem.stiffness * x[0] - problem.friction_force * x[2];
    slope[2] = problem.contact_stiffness * (sliding - std::abs(sliding) * x[2]);
    slope[3] = x[2];
  }
};

class Dopri5 final : public Contender {
 public:
  Dopri5(const Problem& problem, double tolerance)
      : right_hand_side_{problem}, tolerance_(tolerance) {}

  void restart() override {
    const Problem& problem = right_hand_side_.problem;
    stepper_ = odeint::make_controlled<odeint::runge_kutta_dopri5<State>>(tolerance_, tolerance_);
    state_ = {problem.displacement, problem.velocity, problem.friction, 0.0};
    tau_ = 0.0;
    step_ = first_step;
    target_ = 0.0;
    steps_ = 0;
  }

  std::string advance(int periods) override {
    const double end = right_hand_side_.problem.periods * carrier_period;
    target_ = std::min(target_ + periods * carrier_period, end);
    const double rounding = 1e-13 * end;
    while (tau_ < target_ - rounding) {
      step_ = std::min(step_, end - tau_);
      if (stepper_.try_step(right_hand_side_, state_, tau_, step_) == odeint::success) {
        ++steps_;
      } else if (step_ < shortest_step) {
        return "step too short to go on";
      }
    }
    return std::isfinite(state_[2]) ? std::string() : "state not finite";
  }

  double friction_integral() const override { return state_[3]; }
  std::uint64_t steps() const override { return steps_; }

 private:
  RightHandSide right_hand_side_;
  double tolerance_;
  Stepper stepper_;
  State state_{};
  double tau_ = 0.0;
  double step_ = first_step;
  double target_ = 0.0;
  std::uint64_t steps_ = 0;
};

}  // namespace

std::unique_ptr<Contender> odeint_dopri5(const Problem& problem, double tolerance) {
  return std::make_unique<Dopri5>(problem, tolerance);
}

}  // namespace sonoglide::peers
