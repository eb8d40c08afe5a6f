/// A scene's plant over one carrier period after another: what a steady orbit is the fixed point of.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "firmware/numeric/turn.hpp"
#include "firmware/plant/outcome.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/loop/plant/plant_port.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

/// A state in multiples of the motion's scales: displacement, velocity, and what the contact
/// remembers.
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

inline constexpr int motion_components = 2;

inline double sliding_m_per_s(const scene::Scene& scene) {
  return std::abs(scene.sliding.profile.front().velocity_m_per_s);
}

/// One carrier period from drive phase 0, in pieces over which the drive is smooth.
inline std::vector<Stretch> period_of(const scene::Scene& scene) {
  const scene::Drive& drive = *scene.drive;
  Stretch whole;
  whole.duration_s = 1.0 / drive.frequency_Hz;
  whole.drive_rate_rad_per_s = drive.rate_rad_per_s();
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
        rate_rad_per_s_(scene.drive->rate_rad_per_s()),
        length_m_(std::max(configure::plant_scales(scene).length_m,
                           sliding_m_per_s(scene) / rate_rad_per_s_)),
        period_(period_of(scene)),
        stiffness_(scene.plant.stiffness_N_per_m /
                   (scene.plant.mass_kg * rate_rad_per_s_ * rate_rad_per_s_)),
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
  /// Ks / (m omega^2).
  double stiffness() const { return stiffness_; }
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
  double stiffness_;
  NormalForce normal_force_;
  std::uint64_t periods_ = 0;
  plant::Error error_ = plant::Error::none;
  EnergyBalance energy_;
};

}  // namespace sonoglide::loop
