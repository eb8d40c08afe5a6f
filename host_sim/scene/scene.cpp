#include "host_sim/scene/scene.hpp"

#include <algorithm>
#include <cmath>

namespace sonoglide::scene {

double Plant::natural_rad_per_s() const {
  return std::sqrt(stiffness_N_per_m / mass_kg);
}

double Sliding::fastest_m_per_s() const {
  double fastest = 0.0;
  for (const SpeedPoint& point : profile) {
    fastest = std::max(fastest, std::abs(point.velocity_m_per_s));
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

double Drive::nearest_frequency_Hz(double asked_Hz) const {
  const double step_Hz = frequency_resolution_Hz;
  return step_Hz > 0.0 ? step_Hz * std::max(1.0, std::round(asked_Hz / step_Hz)) : asked_Hz;
}

double Scene::drive_force_N() const {
  return drive->force_amplitude_N +
         (transducer ? transducer->force_N(drive->voltage_amplitude_V) : 0.0);
}

double Scene::max_drive_force_N() const {
  return drive->max_force_amplitude_N +
         (transducer ? transducer->force_N(drive->max_voltage_amplitude_V) : 0.0);
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
