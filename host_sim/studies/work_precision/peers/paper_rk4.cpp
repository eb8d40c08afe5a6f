#include "host_sim/studies/work_precision/peers/contender.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

namespace sonoglide::peers {
namespace {

/// The drive at the half steps of a carrier period.
class TabulatedCosine {
 public:
  TabulatedCosine(double amplitude, double half_step, std::size_t half_steps) {
    for (std::size_t i = 0; i <= half_steps; ++i) {
      samples_.push_back(amplitude * std::cos(half_step * static_cast<double>(i)));
    }
  }
  double at(std::size_t i) const { return samples_[i]; }

 private:
  std::vector<double> samples_;
};

class ComputedCosine {
 public:
  ComputedCosine(double amplitude, double half_step, std::size_t /*half_steps*/)
      : amplitude_(amplitude), half_step_(half_step) {}
  double at(std::size_t i) const {
    return amplitude_ * std::cos(half_step_ * static_cast<double>(i));
  }

 private:
  double amplitude_;
  double half_step_;
};

struct Undamped {
  explicit Undamped(double /*damping*/) {}
  double force(double /*velocity*/) const { return 0.0; }
};

struct Damped {
  explicit Damped(double damping_number) : damping(damping_number) {}
  double force(double velocity) const { return damping * velocity; }
  double damping;
};

/// In terms of Y = sigma y, which takes sigma out of the loop.
template <class Cosine, class Damping>
class PaperRk4 final : public Contender {
 public:
  PaperRk4(const Problem& problem, std::size_t steps_per_period)
      : problem_(problem),
        damping_(problem.damping),
        count_(steps_per_period),
        step_(carrier_period / static_cast<double>(steps_per_period)),
        cosine_(problem.vibration_sign * problem.drive_amplitude, 0.5 * step_, 2 * count_) {}

  void restart() override {
    state_ = {problem_.vibration_sign * problem_.displacement,
              problem_.vibration_sign * problem_.velocity, problem_.friction};
    integral_ = 0.0;
    steps_ = 0;
  }

  std::string advance(int periods) override {
    for (int i = 0; i < periods; ++i) {
      integral_ += period();
      steps_ += count_;
      // Not a number, too, fails the comparison.
      if (!(std::abs(state_.friction) <= 1.0 + 1e-12)) {
        return "friction bound broken";
      }
    }
    return {};
  }

  double friction_integral() const override { return integral_; }
  std::uint64_t steps() const override { return steps_; }

 private:
  struct State {
    double displacement;
    double velocity;
    double friction;
  };

  State slope(const State& x, double drive) const {
    const double sliding = problem_.sliding_velocity + x.velocity;
    return {x.velocity,
            drive - damping_.force(x.velocity) - problem_.stiffness * x.displacement -
                pull_ * x.friction,
            problem_.contact_stiffness * (sliding - std::abs(sliding) * x.friction)};
  }

  static State moved(const State& x, const State& slope, double time) {
    return {x.displacement + time * slope.displacement, x.velocity + time * slope.velocity,
            x.friction + time * slope.friction};
  }

  /// One carrier period; returns its integral of phi by the method's own weights.
  double period() {
    State x = state_;
    const double half = 0.5 * step_;
    const double sixth = step_ / 6.0;
    double sum = 0.0;
    double drive = cosine_.at(0);
    for (std::size_t i = 0; i < count_; ++i) {
      const double middle = cosine_.at(2 * i + 1);
      const double next = cosine_.at(2 * i + 2);
      const State k1 = slope(x, drive);
      const State second = moved(x, k1, half);
      const State k2 = slope(second, middle);
      const State third = moved(x, k2, half);
      const State k3 = slope(third, middle);
      const State fourth = moved(x, k3, step_);
      const State k4 = slope(fourth, next);
      sum += x.friction + 2.0 * (second.friction + third.friction) + fourth.friction;
      x = {x.displacement + sixth * (k1.displacement + 2.0 * (k2.displacement + k3.displacement) +
                                     k4.displacement),
           x.velocity + sixth * (k1.velocity + 2.0 * (k2.velocity + k3.velocity) + k4.velocity),
           x.friction + sixth * (k1.friction + 2.0 * (k2.friction + k3.friction) + k4.friction)};
      drive = next;
    }
    state_ = x;
    return sixth * sum;
  }

  const Problem problem_;
  const Damping damping_;
  const double pull_ = problem_.vibration_sign * problem_.friction_force;
  const std::size_t count_;
  const double step_;
  const Cosine cosine_;
  State state_{};
  double integral_ = 0.0;
  std::uint64_t steps_ = 0;
};

template <class Cosine>
std::unique_ptr<Contender> paper_rk4(const Problem& problem, double steps_per_period) {
  const auto count = static_cast<std::size_t>(steps_per_period);
  if (problem.damping > 0.0) {
    return std::make_unique<PaperRk4<Cosine, Damped>>(problem, count);
  }
  return std::make_unique<PaperRk4<Cosine, Undamped>>(problem, count);
}

}  // namespace

std::unique_ptr<Contender> rk4_table(const Problem& problem, double steps_per_period) {
  return paper_rk4<TabulatedCosine>(problem, steps_per_period);
}

std::unique_ptr<Contender> rk4_naive(const Problem& problem, double steps_per_period) {
  return paper_rk4<ComputedCosine>(problem, steps_per_period);
}

}  // namespace sonoglide::peers
