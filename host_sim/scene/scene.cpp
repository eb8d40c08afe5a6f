#include "host_sim/scene/scene.hpp"

namespace sonoglide::scene {

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
