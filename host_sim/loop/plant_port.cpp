#include "host_sim/loop/plant_port.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>

#include "firmware/friction/coulomb.hpp"
#include "firmware/friction/dahl.hpp"
#include "firmware/friction/gauss_legendre.hpp"
#include "firmware/friction/none.hpp"
#include "firmware/plant/account.hpp"
#include "firmware/plant/damping.hpp"
#include "firmware/plant/drive.hpp"
#include "firmware/plant/event_taylor.hpp"
#include "firmware/plant/model.hpp"
#include "firmware/plant/observer.hpp"
#include "firmware/plant/rk4.hpp"
#include "host_sim/loop/type.hpp"
#include "host_sim/scene/plant_scales.hpp"

namespace sonoglide::loop {
namespace {

using scene::PlantNumbers;
using scene::PlantScales;

/// Integrals of the state over every step, by quadrature of its dense output.
struct StoredEnergyIntegral {
  double stiffness;
  double kinetic_and_elastic = 0.0;

  template <class Step>
  void add(const Step& step) {
    static constexpr auto rule = friction::gauss_legendre<10>();
    for (std::size_t i = 0; i < rule.node.size(); ++i) {
      const plant::State<double> state = step.at(rule.node[i] * step.length());
      const double stored = 0.5 * (state.velocity * state.velocity +
                                   stiffness * state.displacement * state.displacement);
      kinetic_and_elastic += rule.weight[i] * step.length() * stored;
    }
  }
};

/// Reads the states that a watch wants off the steps as they are taken.
class Observation {
 public:
  Observation(const Watch& watch, double time_scale, double stiffness,
              std::vector<plant::State<double>>& seen)
      : watch_(watch), time_scale_(time_scale), seen_(seen), stored_energy_{stiffness} {}

  template <class Step>
  void operator()(const Step& step) {
    const double end = step.begin() + step.length();
    for (; next_ < watch_.offsets_s.size(); ++next_) {
      const double offset = watch_.offsets_s[next_] * time_scale_;
      if (offset > end) {
        break;
      }
      seen_.push_back(step.at(std::max(0.0, offset - step.begin())));
    }
    if (watch_.stored_energy) {
      stored_energy_.add(step);
    }
    last_ = step.at(step.length());
  }

  /// Offsets that rounding has put past the last step.
  void finish() {
    for (; next_ < watch_.offsets_s.size(); ++next_) {
      seen_.push_back(last_);
    }
  }

  double stored_energy_integral() const { return stored_energy_.kinetic_and_elastic; }

 private:
  const Watch& watch_;
  double time_scale_;
  std::vector<plant::State<double>>& seen_;
  StoredEnergyIntegral stored_energy_;
  plant::State<double> last_{};
  std::size_t next_ = 0;
};

template <class Solver>
class ComposedPlant final : public PlantPort {
 public:
  using Model = typename Solver::Model;

  ComposedPlant(const PlantScales& scales, const Model& model, double precision,
                const plant::State<double>& initial)
      : scales_(scales), model_(model), state_(initial) {
    solver_.configure(model, precision);
  }

  plant::Outcome<double> advance(const Stretch& stretch, const Watch& watch, EnergyBalance& energy,
                                 std::vector<PlantState>& seen) override {
    const double omega = scales_.angular_frequency_rad_per_s;
    const plant::Interval<double> interval{
        stretch.drive_phase_rad, stretch.duration_s * omega,
        stretch.drive_amplitude_N / scales_.force_N,
        stretch.sliding_velocity_m_per_s / scales_.velocity_m_per_s(),
        stretch.sliding_acceleration_m_per_s2 / (scales_.velocity_m_per_s() * omega)};
    const plant::State<double> before = state_;
    plant::EnergyAccount<double> account;
    plant::Outcome<double> outcome;
    double stored_integral = 0.0;
    if (watch.stored_energy || !watch.offsets_s.empty()) {
      seen_.clear();
      Observation observation(watch, omega, model_.stiffness, seen_);
      outcome = solver_.advance(interval, state_, account, observation);
      observation.finish();
      stored_integral = observation.stored_energy_integral();
      for (const plant::State<double>& state : seen_) {
        seen.push_back(in_si_units(state));
      }
    } else {
      plant::NoObserver nobody;
      outcome = solver_.advance(interval, state_, account, nobody);
    }
    energy = balance(stretch, account, before, stored_integral);
    outcome.offset /= omega;
    return outcome;
  }

  PlantState state() const override { return in_si_units(state_); }
  plant::Cost cost() const override { return solver_.cost(); }

 private:
  PlantState in_si_units(const plant::State<double>& state) const {
    return {state.displacement * scales_.length_m, state.velocity * scales_.velocity_m_per_s(),
            state.friction * scales_.friction_N};
  }

  EnergyBalance balance(const Stretch& stretch, const plant::EnergyAccount<double>& account,
                        const plant::State<double>& before, double stored_integral) const {
    const double duration = stretch.duration_s;
    const double first = stretch.sliding_velocity_m_per_s;
    const double last = first + stretch.sliding_acceleration_m_per_s2 * duration;
    const double sign = first + last < 0.0 ? -1.0 : 1.0;
    const double omega = scales_.angular_frequency_rad_per_s;
    const double energy_J = scales_.force_N * scales_.length_m;
    const double friction_J = scales_.friction_N * scales_.length_m;
    const double inertia_kg = scales_.force_N / (scales_.length_m * omega * omega);
    const double travel_m = (state_.displacement - before.displacement) * scales_.length_m;

    EnergyBalance energy;
    energy.duration_s = duration;
    energy.sliding_distance_m = 0.5 * std::abs(first + last) * duration;
    energy.friction_impulse_N_s = account.friction_integral * scales_.friction_N / omega;
    energy.resistance_impulse_N_s = sign * energy.friction_impulse_N_s;
    energy.friction_work_J = account.friction_work * friction_J;
    energy.pull_work_J = account.sliding_work * friction_J;
    energy.drive_work_J = account.drive_work * energy_J;
    energy.damping_work_J = account.damping_work * energy_J;
    energy.stored_begin_J = model_.stored_energy(before) * energy_J;
    energy.stored_end_J = model_.stored_energy(state_) * energy_J;
    energy.stored_integral_J_s = stored_integral * energy_J / omega;
    energy.momentum_integral_J_s = inertia_kg * 0.5 * (first + last) * travel_m;
    return energy;
  }

  PlantScales scales_;
  Model model_;
  Solver solver_;
  plant::State<double> state_;
  std::vector<plant::State<double>> seen_;
};

// The parts of a model, filled in.

plant::Contact<friction::None<double>> contact(const PlantNumbers& /*numbers*/, double /*sign*/,
                                               Type<friction::None<double>> /*law*/) {
  return {};
}
plant::Contact<friction::Coulomb<double>> contact(const PlantNumbers& numbers, double sign,
                                                  Type<friction::Coulomb<double>> /*law*/) {
  return {{}, numbers.friction_force, sign};
}
plant::Contact<friction::Dahl<double>> contact(const PlantNumbers& numbers, double sign,
                                               Type<friction::Dahl<double>> /*law*/) {
  return {{numbers.contact_stiffness}, numbers.friction_force, sign};
}
plant::Undamped<double> damper(const PlantNumbers& /*numbers*/,
                               Type<plant::Undamped<double>> /*damping*/) {
  return {};
}
plant::Damped<double> damper(const PlantNumbers& numbers, Type<plant::Damped<double>> /*damping*/) {
  return {numbers.damping};
}

plant::State<double> initial_state(const scene::Scene& scene, const PlantScales& scales) {
  const double friction_N = scales.friction_N;
  return {scene.plant.initial_displacement_m / scales.length_m,
          scene.plant.initial_velocity_m_per_s / scales.velocity_m_per_s(),
          friction_N > 0.0 ? scene.friction.initial_force_N / friction_N : 0.0};
}

// A scene's choice of each part, made once, before the loop.

using LawChoice = std::variant<Type<friction::None<double>>, Type<friction::Coulomb<double>>,
                               Type<friction::Dahl<double>>>;
using DampingChoice = std::variant<Type<plant::Undamped<double>>, Type<plant::Damped<double>>>;
using DriveChoice = std::variant<Type<plant::NoDrive>, Type<plant::CosineDrive>>;

LawChoice law_of(const scene::Scene& scene) {
  // Without a friction force there is no friction, whatever the law.
  if (scene::friction_limit_N(scene.friction) > 0.0) {
    if (scene.friction.law == scene::FrictionLaw::dahl) {
      return Type<friction::Dahl<double>>{};
    }
    if (scene.friction.law == scene::FrictionLaw::coulomb) {
      return Type<friction::Coulomb<double>>{};
    }
  }
  return Type<friction::None<double>>{};
}

DampingChoice damping_of(const scene::Scene& scene) {
  if (scene.plant.damping_N_s_per_m > 0.0) {
    return Type<plant::Damped<double>>{};
  }
  return Type<plant::Undamped<double>>{};
}

DriveChoice drive_of(const scene::Scene& scene) {
  if (scene.drive && (scene.drive->force_amplitude_N > 0.0 || scene.controller)) {
    return Type<plant::CosineDrive>{};
  }
  return Type<plant::NoDrive>{};
}

template <class Model>
std::unique_ptr<PlantPort> with_solver(const scene::Scene& scene, const PlantScales& scales,
                                       const Model& model) {
  const plant::State<double> initial = initial_state(scene, scales);
  if (scene.solver.method == scene::SolverMethod::rk4) {
    const double step = scene.solver.step_s * scales.angular_frequency_rad_per_s;
    return std::make_unique<ComposedPlant<plant::Rk4<Model>>>(scales, model, step, initial);
  }
  const double tolerance = scene.solver.tolerance;
  if (tolerance >= 1e-5) {
    return std::make_unique<ComposedPlant<plant::EventTaylor<Model, 8>>>(scales, model, tolerance,
                                                                         initial);
  }
  if (tolerance >= 1e-9) {
    return std::make_unique<ComposedPlant<plant::EventTaylor<Model, 12>>>(scales, model, tolerance,
                                                                          initial);
  }
  return std::make_unique<ComposedPlant<plant::EventTaylor<Model, 16>>>(scales, model, tolerance,
                                                                        initial);
}

}  // namespace

std::unique_ptr<PlantPort> make_plant_port(const scene::Scene& scene) {
  const PlantScales scales = scene::plant_scales(scene);
  const PlantNumbers numbers = scene::plant_numbers(scene, scales);
  const double sign =
      scene.friction.sign_convention == scene::SignConvention::dissipative ? 1.0 : -1.0;
  return std::visit(
      [&](auto law, auto damping, auto drive) {
        using Model = plant::Model<typename decltype(law)::type, typename decltype(damping)::type,
                                   typename decltype(drive)::type>;
        return with_solver(
            scene, scales,
            Model{contact(numbers, sign, law), damper(numbers, damping), numbers.stiffness});
      },
      law_of(scene), damping_of(scene), drive_of(scene));
}

}  // namespace sonoglide::loop
