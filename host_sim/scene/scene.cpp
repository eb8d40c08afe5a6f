#include "host_sim/scene/scene.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/numeric/turn.hpp"

namespace sonoglide::scene {

double natural_Hz(double stiffness_N_per_m, double mass_kg) {
  return std::sqrt(stiffness_N_per_m / mass_kg) / numeric::two_pi;
}

double Plant::natural_rad_per_s() const {
  return std::sqrt(stiffness_N_per_m / mass_kg);
}

double Plant::natural_Hz() const {
  return scene::natural_Hz(stiffness_N_per_m, mass_kg);
}

double Plant::stiffest_N_per_m() const {
  return stiffness_profile.empty() ? stiffness_N_per_m : largest_value(stiffness_profile);
}

double Sliding::fastest_m_per_s() const {
  double fastest = 0.0;
  for (const SpeedPoint& point : profile) {
    fastest = std::max(fastest, std::abs(point.velocity_m_per_s));
  }
  return fastest;
}

double Load::fastest_m_per_s() const {
  double fastest = initial_velocity_m_per_s;
  const auto compare = [&fastest](double velocity_m_per_s) {
    fastest = std::abs(velocity_m_per_s) > std::abs(fastest) ? velocity_m_per_s : fastest;
  };
  for (const SpeedPoint& point : pull_profile_m_per_s) {
    compare(point.velocity_m_per_s);
  }
  for (const TimedValue& row : force_profile_N) {
    compare(damping_N_s_per_m > 0.0 ? row.value / damping_N_s_per_m : 0.0);
  }
  return fastest;
}

double Friction::largest_limit_N() const {
  const ContactValues& given = *this;
  ContactValues most = given;
  if (!coefficient_profile.empty()) {
    most.coefficient = largest_value(coefficient_profile);
  }
  if (!normal_force_profile_N.empty()) {
    most.normal_force_N = largest_value(normal_force_profile_N);
  }
  return most.limit_N();
}

double Drive::highest_frequency_Hz() const {
  return frequency_profile.empty() ? frequency_Hz : largest_value(frequency_profile);
}

double Drive::rate_rad_per_s() const {
  return numeric::two_pi * frequency_Hz;
}

double Drive::nearest_frequency_Hz(double asked_Hz) const {
  return std::max(frequency_resolution_Hz, nearest_multiple(asked_Hz, frequency_resolution_Hz));
}

double Scene::drive_force_N() const {
  return drive->force_amplitude_N +
         (transducer ? transducer->force_N(drive->voltage_amplitude_V) : 0.0);
}

double Scene::max_drive_force_N() const {
  return drive->max_force_amplitude_N +
         (transducer ? transducer->force_N(drive->max_voltage_amplitude_V) : 0.0);
}

double Texture::at(double distance_m) const {
  const double periods = distance_m / period_m;
  const double place = (periods - std::floor(periods)) * static_cast<double>(values.size());
  const auto before = std::min(static_cast<std::size_t>(place), values.size() - 1);
  const double part = place - static_cast<double>(before);
  return values[before] + part * (values[(before + 1) % values.size()] - values[before]);
}

std::vector<double> Controller::target_values() const {
  std::vector<double> values = texture ? texture->values : std::vector<double>();
  for (const TargetStep& step : targets()) {
    values.push_back(step.value);
  }
  return values;
}

const char* Controller::target_key() const {
  if (texture) {
    return "target_texture";
  }
  return holds_force() ? "target_friction_force_N" : "target_friction_ratio";
}

double Scene::highest_target() const {
  return controller->holds_force() ? sensor.force_full_scale_N : 1.0;
}

double Scene::amplitude_step_N() const {
  return drive->bits ? std::ldexp(max_drive_force_N(), -*drive->bits) : 0.0;
}

VibrationMode Scene::vibration_mode() const {
  if (!controller || !controller->vibration) {
    return VibrationMode::feedforward;
  }
  if (*controller->vibration == VibrationControl::resonant) {
    return VibrationMode::resonant;
  }
  return sensor.vibration ? VibrationMode::damped : VibrationMode::sensorless;
}

const char* Scene::profile_key() const {
  if (!plant.stiffness_profile.empty()) {
    return "plant.stiffness_profile";
  }
  if (!friction.coefficient_profile.empty()) {
    return "friction.coefficient_profile";
  }
  if (!friction.normal_force_profile_N.empty()) {
    return "friction.normal_force_profile_N";
  }
  return drive && !drive->frequency_profile.empty() ? "drive.frequency_profile" : nullptr;
}

}  // namespace sonoglide::scene
