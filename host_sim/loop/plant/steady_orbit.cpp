#include "host_sim/loop/plant/steady_orbit.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <string>

#include "firmware/numeric/turn.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/loop/plant/failure.hpp"
#include "host_sim/loop/plant/period_map.hpp"
#include "host_sim/scene/solver_facts.hpp"

namespace sonoglide::loop {
namespace {

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

/// How far a component of the state is moved for a difference. Neither the velocity nor what a spring
/// makes of the displacement in a carrier period may change by more than that part of the velocities:
/// on a soft spring the displacement under the mean friction is far larger than they are, and a part of
/// it would turn the sliding.
double moved(const PeriodMap& map, const Vector& at, int component, double difference) {
  if (component >= motion_components) {
    return difference;
  }
  const double velocity = std::max(1.0, std::abs(at[1]));
  if (component == 1) {
    return difference * velocity;
  }
  const double harmless = velocity / (numeric::two_pi * std::abs(map.stiffness()));
  return difference * std::max(1.0, std::min(size_of_motion(at), harmless));
}

/// dP/dz by central differences, one-sided where the contact is at a limit.
std::optional<Matrix> derivative(PeriodMap& map, const Vector& at, double difference) {
  Matrix result(at.size(), at.size());
  for (int i = 0; i < at.size(); ++i) {
    const double part = moved(map, at, i, difference);
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
  const double omega = scene.drive->rate_rad_per_s();
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
