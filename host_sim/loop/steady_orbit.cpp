#include "host_sim/loop/steady_orbit.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <optional>
#include <string>

#include "firmware/numeric/turn.hpp"
#include "host_sim/loop/computation_error.hpp"
#include "host_sim/scene/plant_scales.hpp"

namespace sonoglide::loop {
namespace {

/// A state in multiples of the motion's scales; friction is left out where it has no memory.
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1>;
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>;

constexpr int friction_component = 2;

bool remembers_friction(const scene::Scene& scene) {
  return scene::is_elastic(scene::acting_law(scene.friction));
}

double sliding_m_per_s(const scene::Scene& scene) {
  return std::abs(scene.sliding.profile.front().velocity_m_per_s);
}

/// The plant over one carrier period after another, from any state at drive phase 0.
class PeriodMap {
 public:
  explicit PeriodMap(const scene::Scene& scene)
      : plant_(make_plant_port(scene)),
        rate_rad_per_s_(numeric::two_pi * scene.drive->frequency_Hz),
        length_m_(std::max(scene::plant_scales(scene).length_m,
                           sliding_m_per_s(scene) / rate_rad_per_s_)),
        friction_N_(scene::friction_limit_N(scene.friction)),
        size_(remembers_friction(scene) ? 3 : 2),
        vibrates_normally_(scene::vibration_of(scene.friction.law) == friction::Vibration::normal),
        period_{1.0 / scene.drive->frequency_Hz,
                0.0,
                rate_rad_per_s_,
                scene.drive->force_amplitude_N,
                scene.sliding.profile.front().velocity_m_per_s,
                0.0} {}

  /// Nothing where the solver fails.
  std::optional<Vector> operator()(const Vector& from) {
    plant_->begin_at(in_si_units(from));
    EnergyBalance energy;
    ++periods_;
    if (plant_->advance(period_, energy).error != plant::Error::none) {
      return std::nullopt;
    }
    return scaled(plant_->state());
  }

  /// The nearest state that the contact can be in; under a normal force that vibrates the contact
  /// finds it itself.
  Vector possible(Vector state) const {
    if (state.size() > friction_component && !vibrates_normally_) {
      state[friction_component] = std::clamp(state[friction_component], -1.0, 1.0);
    }
    return state;
  }

  /// Where the last call has led.
  PlantState state() const { return plant_->state(); }
  std::uint64_t periods() const { return periods_; }

  Vector scaled(const PlantState& state) const {
    Vector vector(size_);
    vector[0] = state.displacement_m / length_m_;
    vector[1] = state.velocity_m_per_s / (length_m_ * rate_rad_per_s_);
    if (size_ > friction_component) {
      vector[friction_component] = state.friction_force_N / friction_N_;
    }
    return vector;
  }

 private:
  PlantState in_si_units(const Vector& vector) const {
    return {vector[0] * length_m_, vector[1] * length_m_ * rate_rad_per_s_,
            size_ > friction_component ? vector[friction_component] * friction_N_ : 0.0};
  }

  std::unique_ptr<PlantPort> plant_;
  double rate_rad_per_s_;
  double length_m_;  ///< of the vibration, or of one that reverses the contact where that is larger
  double friction_N_;
  int size_;
  bool vibrates_normally_;
  Stretch period_;
  std::uint64_t periods_ = 0;
};

/// At least 1.
double size_of_motion(const Vector& state) {
  return std::max(1.0, std::hypot(state[0], state[1]));
}

/// dP/dz by central differences, one-sided where friction is at its limit.
std::optional<Matrix> derivative(PeriodMap& map, const Vector& at, double difference) {
  Matrix result(at.size(), at.size());
  for (int i = 0; i < at.size(); ++i) {
    const double part = i == friction_component ? difference : difference * size_of_motion(at);
    Vector low = at;
    Vector high = at;
    low[i] -= part;
    high[i] += part;
    low = map.possible(low);
    high = map.possible(high);
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
PlantState vibration_without_contact(const scene::Scene& scene) {
  const double omega = numeric::two_pi * scene.drive->frequency_Hz;
  const std::complex<double> dynamic_stiffness(
      scene.plant.stiffness_N_per_m - scene.plant.mass_kg * omega * omega,
      scene.plant.damping_N_s_per_m * omega);
  if (!(std::abs(dynamic_stiffness) > 0.0)) {
    return {0.0, 0.0, 0.0};
  }
  const std::complex<double> amplitude_m = scene.drive->force_amplitude_N / dynamic_stiffness;
  return {amplitude_m.real(), -omega * amplitude_m.imag(), 0.0};
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
        return map_.possible(at_ + correction);
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
      const Vector trial = map_.possible(at_ + part * correction);
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

/// From the vibration without a contact, then from one that reverses the contact in step with the
/// drive, as at resonance; where both lead nowhere, from later and later states of the motion out
/// of the scene's initial state.
std::optional<Vector> closed_orbit(PeriodMap& map, Shooting& shooting, const scene::Scene& scene) {
  for (const PlantState& start :
       {vibration_without_contact(scene), PlantState{0.0, 2.0 * sliding_m_per_s(scene), 0.0}}) {
    if (auto orbit = shooting(map.scaled(start))) {
      return orbit;
    }
  }
  std::optional<Vector> passing =
      map.scaled({scene.plant.initial_displacement_m, scene.plant.initial_velocity_m_per_s,
                  scene.friction.initial_force_N});
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

[[noreturn]] void fail(const std::string& why, const PlantState& state) {
  throw ComputationError(fmt::format(
      "steady orbit: {}; at drive phase 0 displacement {:.6g} m, velocity {:.6g} m/s, friction "
      "force {:.6g} N",
      why, state.displacement_m, state.velocity_m_per_s, state.friction_force_N));
}

}  // namespace

SteadyOrbit find_steady_orbit(const scene::Scene& scene) {
  PeriodMap map(scene);
  Shooting shooting(map, scene::is_adaptive(scene.solver.method) ? scene.solver.tolerance : 0.0);
  const auto orbit = closed_orbit(map, shooting, scene);
  if (!orbit) {
    fail(fmt::format("none of the drive's period found in {} carrier periods; the drive may put in "
                     "more than friction and damping take out",
                     map.periods()),
         map.state());
  }
  const auto slope = derivative(map, *orbit, shooting.difference());
  if (!slope || !map(*orbit)) {
    fail("found, but the solver fails beside it", map.state());
  }
  const double multiplier = slope->eigenvalues().cwiseAbs().maxCoeff();
  if (multiplier > 1.0 + largest_rounding) {
    fail(fmt::format("it repels, a deviation grows by a factor of {:.9g} in each carrier period",
                     multiplier),
         map.state());
  }
  return {map.state(), multiplier, map.periods()};
}

}  // namespace sonoglide::loop
