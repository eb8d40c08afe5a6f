#include "tests/host_sim/loop/equations/friction_equations.hpp"

#include <algorithm>
#include <cmath>

namespace sonoglide::equations {
namespace {

double sliding_speed(const State& state, const Instant& now) {
  return now.sliding_m_per_s + state[1];
}

class NoFriction final : public FrictionEquations {
 public:
  using FrictionEquations::FrictionEquations;
  double friction_N(const State& /*state*/, const Instant& /*now*/) const override { return 0.0; }
};

/// A force that depends on the direction of the sliding velocity V, which turns at a piece's end.
class Turning : public FrictionEquations {
 public:
  using FrictionEquations::FrictionEquations;
  double margin(const State& state, const Instant& now) const override {
    return direction_ * sliding_speed(state, now);
  }
  void enter_piece(State& state, const Instant& now) override {
    direction_ = std::copysign(1.0, sliding_speed(state, now));
  }

 protected:
  double direction_ = 1.0;
};

/// Bristles that relax to a force. What a falling bound leaves above it is cut off: there the force
/// follows the bound for as long as it would fall less by itself.
class Relaxing : public Turning {
 public:
  using Turning::Turning;
  void add_memory_rate(const State& state, const Instant& now, State& rate) const override {
    rate[memory] = cut_ ? std::copysign(1.0, state[memory]) * bound_N_per_s(now)
                        : relaxing_N_per_s(state, now);
  }
  double margin(const State& state, const Instant& now) const override {
    const double turning = Turning::margin(state, now);
    if (bound_N_per_s(now) >= 0.0) {
      return turning;
    }
    return std::min(turning, cut_ ? excess(state, now)
                                  : 1.0 + rounding - std::abs(state[memory]) / bound_N(now));
  }
  void enter_piece(State& state, const Instant& now) override {
    Turning::enter_piece(state, now);
    const double most_N = bound_N(now);
    cut_ = std::abs(state[memory]) >= most_N * (1.0 - rounding) && excess(state, now) > 0.0;
    state[memory] = std::clamp(state[memory], -most_N, most_N);
  }

 protected:
  virtual double relaxing_N_per_s(const State& state, const Instant& now) const = 0;
  virtual double bound_N(const Instant& now) const = 0;
  virtual double bound_N_per_s(const Instant& now) const = 0;

 private:
  static constexpr double rounding = 1e-13;

  /// By how much the force would rise faster than the bound, of the size of both.
  double excess(const State& state, const Instant& now) const {
    const double sign = std::copysign(1.0, state[memory]);
    const double own = sign * relaxing_N_per_s(state, now);
    const double bound = bound_N_per_s(now);
    return bound == 0.0 ? -1.0 : (own - bound) / (std::abs(own) + std::abs(bound));
  }

  bool cut_ = false;
};

/// dF/dt = Kt (V - |V| F / Fc).
class Dahl final : public Relaxing {
 public:
  using Relaxing::Relaxing;
  double friction_N(const State& state, const Instant& /*now*/) const override {
    return state[memory];
  }

 private:
  double relaxing_N_per_s(const State& state, const Instant& now) const override {
    return contact_.contact_stiffness_N_per_m * sliding_speed(state, now) *
           (1.0 - direction_ * state[memory] / limit_N(now));
  }
  double bound_N(const Instant& now) const override { return limit_N(now); }
  double bound_N_per_s(const Instant& now) const override { return limit_N_per_s(now); }
};

/// sigma0 z is remembered: dz/dt = V - |V| sigma0 z / G, F = sigma0 z + sigma1 dz/dt + sigma2 V.
class LuGre final : public Relaxing {
 public:
  using Relaxing::Relaxing;
  double friction_N(const State& state, const Instant& now) const override {
    return state[memory] + contact_.bristle_damping_N_s_per_m * bending(state, now) +
           contact_.viscous_friction_N_s_per_m * sliding_speed(state, now);
  }

 private:
  double relaxing_N_per_s(const State& state, const Instant& now) const override {
    return contact_.contact_stiffness_N_per_m * bending(state, now);
  }
  double bound_N(const Instant& now) const override {
    return contact_.static_coefficient * load_N(now);
  }
  double bound_N_per_s(const Instant& now) const override {
    return contact_.static_coefficient * now.normal_force_N_per_s;
  }
  double bending(const State& state, const Instant& now) const {
    const double speed = sliding_speed(state, now);
    const double part = speed / contact_.stribeck_velocity_m_per_s;
    const double curve_N =
        load_N(now) * (coefficient(now) +
                       (contact_.static_coefficient - coefficient(now)) * std::exp(-part * part));
    return speed * (1.0 - direction_ * state[memory] / curve_N);
  }
};

/// Springs of Kt / n, each with a slider at (2 i - 1) Fc / n^2, where it stays while its spring is
/// loaded faster than the limit rises.
class Iwan final : public FrictionEquations {
 public:
  using FrictionEquations::FrictionEquations;
  double friction_N(const State& state, const Instant& /*now*/) const override {
    double sum = 0.0;
    for (std::size_t i = 0; i < contact_.elements; ++i) {
      sum += state[memory + i];
    }
    return sum;
  }
  void add_memory_rate(const State& state, const Instant& now, State& rate) const override {
    for (std::size_t i = 0; i < contact_.elements; ++i) {
      rate[memory + i] = slips_[i] ? std::copysign(part(i), state[memory + i]) * limit_N_per_s(now)
                                   : loading_N_per_s(state, now);
    }
  }
  double margin(const State& state, const Instant& now) const override {
    double margin = 1.0;
    for (std::size_t i = 0; i < contact_.elements; ++i) {
      margin = std::min(
          margin, slips_[i] ? excess(state, now, i)
                            : 1.0 + rounding - std::abs(state[memory + i]) / slip_limit_N(now, i));
    }
    return margin;
  }
  void enter_piece(State& state, const Instant& now) override {
    for (std::size_t i = 0; i < contact_.elements; ++i) {
      const double limit_N = slip_limit_N(now, i);
      slips_[i] =
          std::abs(state[memory + i]) >= limit_N * (1.0 - rounding) && excess(state, now, i) > 0.0;
      state[memory + i] = std::clamp(state[memory + i], -limit_N, limit_N);
    }
  }

 private:
  static constexpr double rounding = 1e-13;

  double part(std::size_t i) const {
    return static_cast<double>(2 * i + 1) /
           static_cast<double>(contact_.elements * contact_.elements);
  }
  double slip_limit_N(const Instant& now, std::size_t i) const { return part(i) * limit_N(now); }
  double loading_N_per_s(const State& state, const Instant& now) const {
    return contact_.contact_stiffness_N_per_m / static_cast<double>(contact_.elements) *
           sliding_speed(state, now);
  }
  /// By how much the load outruns the limit, of the size of both.
  double excess(const State& state, const Instant& now, std::size_t i) const {
    const double load = std::copysign(1.0, state[memory + i]) * loading_N_per_s(state, now);
    const double limit = part(i) * limit_N_per_s(now);
    return (load - limit) / (std::abs(load) + std::abs(limit));
  }

  std::array<bool, most_elements> slips_{};
};

/// At V = 0 it holds by whatever that takes, up to the limit; else a force that V gives.
class Sticking : public FrictionEquations {
 public:
  using FrictionEquations::FrictionEquations;
  double friction_N(const State& state, const Instant& now) const override {
    return direction_ == 0.0 ? holding_N(state, now)
                             : sliding_N(direction_, sliding_speed(state, now), now);
  }
  double margin(const State& state, const Instant& now) const override {
    return direction_ == 0.0 ? 1.0 - std::abs(holding_N(state, now)) / limit_N(now)
                             : direction_ * sliding_speed(state, now);
  }
  void enter_piece(State& state, const Instant& now) override {
    const double speed = sliding_speed(state, now);
    if (std::abs(speed) > at_rest_m_per_s) {
      direction_ = std::copysign(1.0, speed);
      return;
    }
    state[1] = -now.sliding_m_per_s;
    const double needed_N = holding_N(state, now);
    direction_ = std::abs(needed_N) < limit_N(now) ? 0.0 : std::copysign(1.0, needed_N);
  }

 protected:
  virtual double sliding_N(double direction, double speed, const Instant& now) const = 0;

 private:
  static constexpr double at_rest_m_per_s = 1e-13;

  /// Keeps V at 0: x'' = -dVt/dt.
  double holding_N(const State& state, const Instant& now) const {
    return free_force_N(state, now) + mass_.mass_kg * now.sliding_m_per_s2;
  }

  double direction_ = 0.0;
};

class Coulomb final : public Sticking {
 public:
  using Sticking::Sticking;

 private:
  double sliding_N(double direction, double /*speed*/, const Instant& now) const override {
    return direction * limit_N(now);
  }
};

/// mu = mu_s sgn V - alpha V + beta V^3.
class Stribeck final : public Sticking {
 public:
  using Sticking::Sticking;

 private:
  double sliding_N(double direction, double speed, const Instant& now) const override {
    return load_N(now) * (coefficient(now) * direction - contact_.fall_s_per_m * speed +
                          contact_.rise_s3_per_m3 * speed * speed * speed);
  }
};

/// Fc against the slip (Vt, x').
class TransverseCoulomb final : public FrictionEquations {
 public:
  using FrictionEquations::FrictionEquations;
  double friction_N(const State& state, const Instant& now) const override {
    return limit_N(now) * now.sliding_m_per_s / std::hypot(now.sliding_m_per_s, state[1]);
  }
  double friction_on_mass_N(const State& state, const Instant& now) const override {
    return limit_N(now) * state[1] / std::hypot(now.sliding_m_per_s, state[1]);
  }
};

/// A slider behind the spring kx, held up to mu N, N = N0 + kz x; the mass does not feel it.
class NormalCoulomb final : public FrictionEquations {
 public:
  using FrictionEquations::FrictionEquations;
  double friction_N(const State& state, const Instant& /*now*/) const override {
    return state[memory];
  }
  double friction_on_mass_N(const State& /*state*/, const Instant& /*now*/) const override {
    return 0.0;
  }
  void add_memory_rate(const State& state, const Instant& now, State& rate) const override {
    rate[memory] = piece_ == Piece::sticks  ? pull_N_per_s(now)
                   : piece_ == Piece::slips ? direction_ * rising_N_per_s(state, now)
                                            : 0.0;
  }
  double margin(const State& state, const Instant& now) const override {
    const double pressure = pressure_N(state, now) / load_N(now);
    switch (piece_) {
      case Piece::lifted:
        return -pressure;
      case Piece::slips:
        return std::min(pressure, excess(state, now));
      case Piece::sticks:
        break;
    }
    return std::min(
        pressure,
        (coefficient(now) * pressure_N(state, now) - std::abs(state[memory])) / limit_N(now));
  }
  void enter_piece(State& state, const Instant& now) override {
    const double most_N = coefficient(now) * pressure_N(state, now);
    if (most_N < 0.0) {
      piece_ = Piece::lifted;
      state[memory] = 0.0;
      return;
    }
    state[memory] = std::clamp(state[memory], -most_N, most_N);
    direction_ = std::copysign(1.0, state[memory] == 0.0 ? now.sliding_m_per_s : state[memory]);
    const bool at_limit = std::abs(state[memory]) >= most_N - rounding * limit_N(now);
    piece_ = at_limit && excess(state, now) > 0.0 ? Piece::slips : Piece::sticks;
  }

 private:
  enum class Piece { sticks, slips, lifted };
  static constexpr double rounding = 1e-13;

  double pressure_N(const State& state, const Instant& now) const {
    return load_N(now) + contact_.normal_contact_stiffness_N_per_m * state[0];
  }
  double rising_N_per_s(const State& state, const Instant& now) const {
    return now.coefficient_per_s * pressure_N(state, now) +
           coefficient(now) *
               (now.normal_force_N_per_s + contact_.normal_contact_stiffness_N_per_m * state[1]);
  }
  double pull_N_per_s(const Instant& now) const {
    return contact_.contact_stiffness_N_per_m * now.sliding_m_per_s;
  }
  /// By how much the pull outruns the limit, of its own size.
  double excess(const State& state, const Instant& now) const {
    return (direction_ * pull_N_per_s(now) - rising_N_per_s(state, now)) /
           (std::abs(pull_N_per_s(now)) + std::abs(rising_N_per_s(state, now)));
  }

  Piece piece_ = Piece::sticks;
  double direction_ = 1.0;
};

template <class Equations>
std::unique_ptr<FrictionEquations> make(const Mass& mass, const Contact& contact) {
  return std::make_unique<Equations>(mass, contact);
}

struct NamedLaw {
  std::string_view name;
  std::unique_ptr<FrictionEquations> (*make)(const Mass&, const Contact&);
};

constexpr std::array<NamedLaw, 8> laws = {{{"none", make<NoFriction>},
                                           {"coulomb", make<Coulomb>},
                                           {"dahl", make<Dahl>},
                                           {"lugre", make<LuGre>},
                                           {"iwan", make<Iwan>},
                                           {"stribeck", make<Stribeck>},
                                           {"transverse_coulomb", make<TransverseCoulomb>},
                                           {"normal_coulomb", make<NormalCoulomb>}}};

}  // namespace

double FrictionEquations::free_force_N(const State& state, const Instant& now) const {
  const double stiffness_N_per_m = mass_.stiffness_N_per_m + now.added_stiffness_N_per_m;
  return now.drive_N - mass_.damping_N_s_per_m * state[1] - stiffness_N_per_m * state[0];
}

State FrictionEquations::rate(const State& state, const Instant& now, double sliding_sign) const {
  State rate{};
  rate[0] = state[1];
  rate[1] = (free_force_N(state, now) - friction_on_mass_N(state, now)) / mass_.mass_kg;
  rate[impulse] = sliding_sign * friction_N(state, now);
  add_memory_rate(state, now, rate);
  return rate;
}

std::unique_ptr<FrictionEquations> make_equations(std::string_view law, const Mass& mass,
                                                  const Contact& contact) {
  for (const NamedLaw& each : laws) {
    if (each.name == law) {
      return each.make(mass, contact);
    }
  }
  return nullptr;
}

}  // namespace sonoglide::equations
