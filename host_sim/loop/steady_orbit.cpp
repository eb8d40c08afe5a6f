#include "host_sim/loop/steady_orbit.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "firmware/numeric/turn.hpp"
#include "firmware/plant/outcome.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/loop/failure.hpp"
#include "host_sim/loop/plant/make_plant_port.hpp"
#include "host_sim/scene/solver_facts.hpp"

namespace sonoglide::loop {
namespace {

/// A state in multiples of the motion's scales: displacement, velocity, and what the contact
/// remembers.
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

constexpr int motion_components = 2;

double sliding_m_per_s(const scene::Scene& scene) {
  return std::abs(scene.sliding.profile.front().velocity_m_per_s);
}

/// One carrier period from drive phase 0, in pieces over which the drive is smooth.
std::vector<Stretch> period_of(const scene::Scene& scene) {
  const scene::Drive& drive = *scene.drive;
  Stretch whole;
  whole.duration_s = 1.0 / drive.frequency_Hz;
  whole.drive_rate_rad_per_s = numeric::two_pi * drive.frequency_Hz;
  whole.drive_amplitude_N = scene.drive_force_N();
  whole.sliding_velocity_m_per_s = scene.sliding.profile.front().velocity_m_per_s;
  whole.drive_waveform = drive.waveform;
  if (drive.waveform == scene::Waveform::cosine || drive.waveform == scene::Waveform::sawtooth) {
    return {whole};
  }
  whole.duration_s *= 0.5;
  Stretch second = whole;
  second.drive_phase_rad = 0.5 * numeric::two_pi;
  return {whole, second};
}

/// The force of a contact that vibrates normally as a number in [-1, 1]. Its part of the limit, which
/// is what the plant takes, says nothing where the contact is about to open at drive phase 0.
class NormalForce {
 public:
  explicit NormalForce(const scene::Scene& scene)
      : limit_N_(scene.friction.limit_N()),
        law_(std::get_if<scene::laws::NormalCoulomb>(&scene.friction.law)) {
    if (law_ != nullptr) {
      indentation_m_ = scene.friction.normal_force_N / law_->normal_contact_stiffness_N_per_m;
    }
  }

  bool is_it() const { return law_ != nullptr && limit_N_ > 0.0; }
  double number(double force_N) const { return force_N / (limit_N_ + std::abs(force_N)); }
  double part_of_limit(double number, double displacement_m) const {
    const double over_resting = number / (1.0 - std::abs(number));
    const double limit = 1.0 + displacement_m / indentation_m_;
    return limit > 0.0 ? std::clamp(over_resting / limit, -1.0, 1.0) : 0.0;
  }

 private:
  double limit_N_;
  const scene::laws::NormalCoulomb* law_;
  double indentation_m_ = 1.0;
};

/// The plant over one carrier period after another, from any state at drive phase 0.
class PeriodMap {
 public:
  PeriodMap(const scene::Scene& scene, std::uint64_t most_steps)
      : most_steps_(most_steps),
        plant_(make_plant_port(scene)),
        rate_rad_per_s_(numeric::two_pi * scene.drive->frequency_Hz),
        length_m_(std::max(configure::plant_scales(scene).length_m,
                           sliding_m_per_s(scene) / rate_rad_per_s_)),
        period_(period_of(scene)),
        normal_force_(scene) {}

  /// Nothing where the solver fails, and when it has taken all its steps.
  std::optional<Vector> operator()(const Vector& from) {
    if (plant_->cost().steps > most_steps_) {
      return std::nullopt;
    }
    plant_->begin_at(motion(from), memory(from));
    ++periods_;
    energy_ = EnergyBalance();
    for (const Stretch& stretch : period_) {
      EnergyBalance part;
      const plant::Error error = plant_->advance(stretch, part).error;
      if (error != plant::Error::none) {
        error_ = error;
        return std::nullopt;
      }
      energy_.append(part);
    }
    return state();
  }

  /// Of the last call.
  const EnergyBalance& energy() const { return energy_; }

  /// Where the last call has led.
  Vector state() const {
    const PlantState state = plant_->state();
    return scaled(state, normal_force_.is_it()
                             ? std::vector<double>{normal_force_.number(state.friction_force_N)}
                             : plant_->memory());
  }
  PlantState plant_state() const { return plant_->state(); }
  std::vector<double> plant_memory() const { return plant_->memory(); }
  std::uint64_t periods() const { return periods_; }
  plant::Cost cost() const { return plant_->cost(); }
  plant::Error error() const { return error_; }  ///< last of the solver in any of the periods

  /// @param load  0: the contact remembers nothing of its past; 1: it has slid on to its limits
  Vector loaded(double displacement_m, double velocity_m_per_s, double load) const {
    return scaled(
        {displacement_m, velocity_m_per_s, 0.0},
        std::vector<double>(plant_->memory().size(),
                            std::copysign(load, period_.front().sliding_velocity_m_per_s)));
  }

 private:
  Vector scaled(const PlantState& state, const std::vector<double>& memory) const {
    Vector vector(motion_components + static_cast<int>(memory.size()));
    vector[0] = state.displacement_m / length_m_;
    vector[1] = state.velocity_m_per_s / (length_m_ * rate_rad_per_s_);
    std::copy(memory.begin(), memory.end(), vector.begin() + motion_components);
    return vector;
  }
  PlantState motion(const Vector& vector) const {
    return {vector[0] * length_m_, vector[1] * length_m_ * rate_rad_per_s_, 0.0};
  }
  std::vector<double> memory(const Vector& vector) const {
    if (normal_force_.is_it()) {
      return {
          normal_force_.part_of_limit(vector[motion_components], motion(vector).displacement_m)};
    }
    return {vector.begin() + motion_components, vector.end()};
  }

  std::uint64_t most_steps_;
  std::unique_ptr<PlantPort> plant_;
  double rate_rad_per_s_;
  double length_m_;  ///< of the vibration, or of one that reverses the contact where that is larger
  std::vector<Stretch> period_;
  NormalForce normal_force_;
  std::uint64_t periods_ = 0;
  plant::Error error_ = plant::Error::none;
  EnergyBalance energy_;
};

/// The nearest state that the contact can be in.
Vector possible(Vector state) {
  for (int i = motion_components; i < state.size(); ++i) {
    state[i] = std::clamp(state[i], -1.0, 1.0);
  }
  return state;
}

/// At least 1.
double size_of_motion(const Vector& state) {
  return std::max(1.0, std::hypot(state[0], state[1]));
}

/// dP/dz by central differences, one-sided where the contact is at a limit.
std::optional<Matrix> derivative(PeriodMap& map, const Vector& at, double difference) {
  Matrix result(at.size(), at.size());
  for (int i = 0; i < at.size(); ++i) {
    const double part = i < motion_components ? difference * size_of_motion(at) : difference;
    Vector low = at;
    Vector high = at;
    low[i] -= part;
    high[i] += part;
    low = possible(low);
    high = possible(high);
    const auto after_low = map(low);
    const auto after_high = map(high);
    if (!after_low || !after_high) {
      return std::nullopt;
    }
    result.col(i) = (*after_high - *after_low) / (high[i] - low[i]);
  }
  return result;
}

/// Displacement and velocity of the steady vibration without a contact; at rest where that has
/// none.
Vector vibration_without_contact(const PeriodMap& map, const scene::Scene& scene, double load) {
  const double omega = numeric::two_pi * scene.drive->frequency_Hz;
  const std::complex<double> stiffness = configure::dynamic_stiffness(scene.plant, omega);
  if (!(std::abs(stiffness) > 0.0)) {
    return map.loaded(0.0, 0.0, load);
  }
  const std::complex<double> amplitude_m = scene.drive_force_N() / stiffness;
  return map.loaded(amplitude_m.real(), -omega * amplitude_m.imag(), load);
}

class Shooting {
 public:
  Shooting(PeriodMap& map, double tolerance)
      : map_(map), accuracy_(std::max(1e-10, tolerance)), difference_(std::sqrt(accuracy_)) {}

  double difference() const { return difference_; }

  /// Newton's method; nothing where it does not arrive.
  std::optional<Vector> operator()(const Vector& from) {
    constexpr int most_corrections = 30;
    at_ = from;
    std::optional<Vector> after = map_(at_);
    for (int i = 0; after && i < most_corrections; ++i) {
      const Vector residual = *after - at_;
      const auto slope = derivative(map_, at_, difference_);
      if (!slope) {
        return std::nullopt;
      }
      Eigen::FullPivLU<Matrix> drift(Matrix::Identity(at_.size(), at_.size()) - *slope);
      if (!drift.setThreshold(least_drift).isInvertible()) {
        return std::nullopt;
      }
      const Vector correction = drift.solve(residual);
      if (correction.norm() <= accuracy_ * size_of_motion(at_)) {
        return possible(at_ + correction);
      }
      after = step(correction, residual.norm());
    }
    return std::nullopt;
  }

 private:
  /// A state whose deviation changes by less than this part in a carrier period belongs to a family
  /// of orbits, of which no one is the steady one.
  static constexpr double least_drift = 1e-8;

  /// Takes as much of a correction as brings the orbit nearer to closing: a full one overshoots
  /// where it passes a reversal. Hands on where the period leads then.
  std::optional<Vector> step(const Vector& correction, double gap) {
    for (const double part : {1.0, 0.5, 0.25, 0.125, 0.0625, 0.03125}) {
      const Vector trial = possible(at_ + part * correction);
      auto after = map_(trial);
      if (after && (*after - trial).norm() < gap) {
        at_ = trial;
        return after;
      }
    }
    return std::nullopt;
  }

  PeriodMap& map_;
  double accuracy_;
  double difference_;
  Vector at_;
};

/// From the vibration without a contact; from the same, the contact having slid on to its limits,
/// as a stuck one has in the end; from one that reverses the contact in step with the drive, as at
/// resonance; where none leads anywhere, from later and later states of the motion out
/// of the scene's initial state.
std::optional<Vector> closed_orbit(PeriodMap& map, Shooting& shooting, const scene::Scene& scene) {
  std::optional<Vector> passing = map.state();
  for (const Vector& start :
       {vibration_without_contact(map, scene, 0.0), vibration_without_contact(map, scene, 1.0),
        map.loaded(0.0, 2.0 * sliding_m_per_s(scene), 0.0)}) {
    if (auto orbit = shooting(start)) {
      return orbit;
    }
  }
  for (const int wait_periods : {30, 300}) {
    for (int i = 0; passing && i < wait_periods; ++i) {
      passing = map(*passing);
    }
    if (!passing) {
      return std::nullopt;
    }
    if (auto orbit = shooting(*passing)) {
      return orbit;
    }
  }
  return std::nullopt;
}

std::string why_none(const scene::Scene& scene, const PeriodMap& map) {
  if (map.error() != plant::Error::none) {
    return "the solver fails in them, " + failure_cause(scene, map.error(), map.cost());
  }
  return scene.plant.stiffness_N_per_m > 0.0
             ? "the drive may put in more than friction and damping take out"
             : "no spring holds the mass in its place";
}

[[noreturn]] void fail(const std::string& why, const PlantState& state) {
  throw ComputationError(fmt::format(
      "steady orbit: {}; at drive phase 0 displacement {:.6g} m, velocity {:.6g} m/s, friction "
      "force {:.6g} N",
      why, state.displacement_m, state.velocity_m_per_s, state.friction_force_N));
}

}  // namespace

SteadyOrbit find_orbit(const scene::Scene& scene, std::uint64_t most_steps) {
  PeriodMap map(scene, most_steps);
  Shooting shooting(map, scene::is_adaptive(scene.solver.method) ? scene.solver.tolerance : 0.0);
  const auto orbit = closed_orbit(map, shooting, scene);
  if (!orbit) {
    fail(fmt::format("none of the drive's period found in {} carrier periods; {}", map.periods(),
                     why_none(scene, map)),
         map.plant_state());
  }
  const auto slope = derivative(map, *orbit, shooting.difference());
  if (!slope || !map(*orbit)) {
    fail("found, but the solver fails beside it", map.plant_state());
  }
  return {map.plant_state(), map.plant_memory(), slope->eigenvalues().cwiseAbs().maxCoeff(),
          map.periods(), map.energy()};
}

SteadyOrbit find_steady_orbit(const scene::Scene& scene, std::uint64_t most_steps) {
  SteadyOrbit orbit = find_orbit(scene, most_steps);
  if (orbit.repels()) {
    fail(fmt::format("it repels, a deviation grows by a factor of {:.9g} in each carrier period",
                     orbit.multiplier),
         orbit.state);
  }
  return orbit;
}

}  // namespace sonoglide::loop
