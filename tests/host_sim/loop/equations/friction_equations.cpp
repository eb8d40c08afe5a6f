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

/// dF/dt = Kt (V - |V| F / Fc).
class Dahl final : public Turning {
 public:
  using Turning::Turning;
  double friction_N(const State& state, const Instant& /*now*/) const override {
    return state[memory];
  }
  void add_memory_rate(const State& state, const Instant& now, State& rate) const override {
    const double speed = sliding_speed(state, now);
    rate[memory] = contact_.contact_stiffness_N_per_m * speed *
                   (1.0 - direction_ * state[memory] / contact_.limit_N());
  }
};

/// sigma0 z is remembered: dz/dt = V - |V| sigma0 z / G, F = sigma0 z + sigma1 dz/dt + sigma2 V.
class LuGre final : public Turning {
 public:
  using Turning::Turning;
  double friction_N(const State& state, const Instant& now) const override {
    return state[memory] + contact_.bristle_damping_N_s_per_m * bending(state, now) +
           contact_.viscous_friction_N_s_per_m * sliding_speed(state, now);
  }
  void add_memory_rate(const State& state, const Instant& now, State& rate) const override {
    rate[memory] = contact_.contact_stiffness_N_per_m * bending(state, now);
  }

 private:
  double bending(const State& state, const Instant& now) const {
    const double speed = sliding_speed(state, now);
    const double part = speed / contact_.stribeck_velocity_m_per_s;
    const double curve_N =
        contact_.normal_force_N *
        (contact_.coefficient +
         (contact_.static_coefficient - contact_.coefficient) * std::exp(-part * part));
    return speed * (1.0 - direction_ * state[memory] / curve_N);
  }
};

/// Springs of Kt / n, each with a slider at (2 i - 1) Fc / n^2.
class Iwan final : public Turning {
 public:
  using Turning::Turning;
  double friction_N(const State& state, const Instant& /*now*/) const override {
    double sum = 0.0;
    for (std::size_t i = 0; i < iwan_elements; ++i) {
      sum += state[memory + i];
    }
    return sum;
  }
  void add_memory_rate(const State& state, const Instant& now, State& rate) const override {
    for (std::size_t i = 0; i < iwan_elements; ++i) {
      rate[memory + i] = slips_[i] ? 0.0
                                   : contact_.contact_stiffness_N_per_m / iwan_elements *
                                         sliding_speed(state, now);
    }
  }
  double margin(const State& state, const Instant& now) const override {
    double margin = Turning::margin(state, now) / fast_m_per_s;
    for (std::size_t i = 0; i < iwan_elements; ++i) {
      if (!slips_[i]) {
        margin = std::min(margin, 1.0 - direction_ * state[memory + i] / slip_limit_N(i));
      }
    }
    return margin;
  }
  void enter_piece(State& state, const Instant& now) override {
    Turning::enter_piece(state, now);
    for (std::size_t i = 0; i < iwan_elements; ++i) {
      const double limit_N = slip_limit_N(i);
      slips_[i] = direction_ * state[memory + i] >= limit_N * (1.0 - rounding);
      state[memory + i] = std::clamp(state[memory + i], -limit_N, limit_N);
    }
  }

 private:
  static constexpr double rounding = 1e-13;
  static constexpr double fast_m_per_s = 1.0;

  double slip_limit_N(std::size_t i) const {
    return contact_.limit_N() * static_cast<double>(2 * i + 1) /
           static_cast<double>(iwan_elements * iwan_elements);
  }

  std::array<bool, iwan_elements> slips_{};
};

/// At V = 0 it holds by whatever that takes, up to the limit; else a force that V gives.
class Sticking : public FrictionEquations {
 public:
  using FrictionEquations::FrictionEquations;
  double friction_N(const State& state, const Instant& now) const override {
    return direction_ == 0.0 ? holding_N(state, now)
                             : sliding_N(direction_, sliding_speed(state, now));
  }
  double margin(const State& state, const Instant& now) const override {
    return direction_ == 0.0 ? 1.0 - std::abs(holding_N(state, now)) / contact_.limit_N()
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
    direction_ = std::abs(needed_N) < contact_.limit_N() ? 0.0 : std::copysign(1.0, needed_N);
  }

 protected:
  virtual double sliding_N(double direction, double speed) const = 0;

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
  double sliding_N(double direction, double /*speed*/) const override {
    return direction * contact_.limit_N();
  }
};

/// mu = mu_s sgn V - alpha V + beta V^3.
class Stribeck final : public Sticking {
 public:
  using Sticking::Sticking;

 private:
  double sliding_N(double direction, double speed) const override {
    return contact_.normal_force_N *
           (contact_.coefficient * direction - contact_.fall_s_per_m * speed +
            contact_.rise_s3_per_m3 * speed * speed * speed);
  }
};

/// Fc against the slip (Vt, x').
class TransverseCoulomb final : public FrictionEquations {
 public:
  using FrictionEquations::FrictionEquations;
  double friction_N(const State& state, const Instant& now) const override {
    return contact_.limit_N() * now.sliding_m_per_s / std::hypot(now.sliding_m_per_s, state[1]);
  }
  double friction_on_mass_N(const State& state, const Instant& now) const override {
    return contact_.limit_N() * state[1] / std::hypot(now.sliding_m_per_s, state[1]);
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
                   : piece_ == Piece::slips ? direction_ * limit_N_per_s(state)
                                            : 0.0;
  }
  double margin(const State& state, const Instant& now) const override {
    const double pressure = normal_N(state) / contact_.normal_force_N;
    switch (piece_) {
      case Piece::lifted:
        return -pressure;
      case Piece::slips:
        return std::min(pressure, excess(state, now));
      case Piece::sticks:
        break;
    }
    return std::min(pressure, (contact_.coefficient * normal_N(state) - std::abs(state[memory])) /
                                  contact_.limit_N());
  }
  void enter_piece(State& state, const Instant& now) override {
    const double limit_N = contact_.coefficient * normal_N(state);
    if (limit_N < 0.0) {
      piece_ = Piece::lifted;
      state[memory] = 0.0;
      return;
    }
    state[memory] = std::clamp(state[memory], -limit_N, limit_N);
    direction_ = std::copysign(1.0, state[memory] == 0.0 ? now.sliding_m_per_s : state[memory]);
    const bool at_limit = std::abs(state[memory]) >= limit_N - rounding * contact_.limit_N();
    piece_ = at_limit && excess(state, now) > 0.0 ? Piece::slips : Piece::sticks;
  }

 private:
  enum class Piece { sticks, slips, lifted };
  static constexpr double rounding = 1e-13;

  double normal_N(const State& state) const {
    return contact_.normal_force_N + contact_.normal_contact_stiffness_N_per_m * state[0];
  }
  double limit_N_per_s(const State& state) const {
    return contact_.coefficient * contact_.normal_contact_stiffness_N_per_m * state[1];
  }
  double pull_N_per_s(const Instant& now) const {
    return contact_.contact_stiffness_N_per_m * now.sliding_m_per_s;
  }
  /// By how much the pull outruns the limit, of its own size.
  double excess(const State& state, const Instant& now) const {
    return (direction_ * pull_N_per_s(now) - limit_N_per_s(state)) /
           (std::abs(pull_N_per_s(now)) + std::abs(limit_N_per_s(state)));
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
