/// A scene of open loop whose friction, spring and pull may change along lines and in jumps, by its
/// equations in SI units and Boost.odeint.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>
#include <vector>

#include "host_sim/scene/scene.hpp"
#include "tests/common/constants/pi.hpp"
#include "tests/host_sim/loop/equations/follow.hpp"

namespace sonoglide::equations {

/// One call for each law that has numbers of its own.
struct OwnNumbers {
  Contact& contact;

  void operator()(const scene::laws::LuGre& law) const {
    contact.static_coefficient = law.static_coefficient;
    contact.stribeck_velocity_m_per_s = law.stribeck_velocity_m_per_s;
    contact.bristle_damping_N_s_per_m = law.bristle_damping_N_s_per_m;
    contact.viscous_friction_N_s_per_m = law.viscous_friction_N_s_per_m;
  }
  void operator()(const scene::laws::Iwan& law) const {
    contact.elements = static_cast<std::size_t>(law.elements);
  }
  void operator()(const scene::laws::Stribeck& law) const {
    contact.fall_s_per_m = law.fall_s_per_m;
    contact.rise_s3_per_m3 = law.rise_s3_per_m3;
  }
  void operator()(const scene::laws::NormalCoulomb& law) const {
    contact.normal_contact_stiffness_N_per_m = law.normal_contact_stiffness_N_per_m;
  }
  template <class Law>
  void operator()(const Law& /*law*/) const {}
};

inline Contact contact_of(const scene::Scene& scene) {
  Contact contact{};
  contact.coefficient = scene.friction.coefficient;
  contact.normal_force_N = scene.friction.normal_force_N;
  contact.contact_stiffness_N_per_m = scene.friction.contact_stiffness_N_per_m;
  std::visit(OwnNumbers{contact}, scene.friction.law);
  return contact;
}

struct Value {
  double now;
  double per_s;
};

/// On the line that holds at piece_s.
inline Value on_line(const scene::TimedProfile& profile, double constant, double time_s,
                     double piece_s) {
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const scene::TimedValue& from = profile[i - 1];
    const scene::TimedValue& to = profile[i];
    if (from.time_s <= piece_s && piece_s < to.time_s) {
      const double slope = (to.value - from.value) / (to.time_s - from.time_s);
      return {from.value + slope * (time_s - from.time_s), slope};
    }
  }
  return {profile.empty() ? constant : scene::value_at(profile, piece_s), 0.0};
}

inline scene::TimedProfile sliding_of(const scene::Scene& scene) {
  scene::TimedProfile profile;
  for (const scene::SpeedPoint& point : scene.sliding.profile) {
    profile.push_back({point.time_s, point.velocity_m_per_s});
  }
  return profile;
}

inline Instant instant(const scene::Scene& scene, const scene::TimedProfile& sliding, double time_s,
                       double piece_s) {
  const scene::Friction& friction = scene.friction;
  const Value velocity = on_line(sliding, 0.0, time_s, piece_s);
  const Value stiffness =
      on_line(scene.plant.stiffness_profile, scene.plant.stiffness_N_per_m, time_s, piece_s);
  const Value coefficient =
      on_line(friction.coefficient_profile, friction.coefficient, time_s, piece_s);
  const Value normal_N =
      on_line(friction.normal_force_profile_N, friction.normal_force_N, time_s, piece_s);
  Instant now{};
  now.drive_N =
      scene.drive->force_amplitude_N * std::cos(tests::two_pi * scene.drive->frequency_Hz * time_s);
  now.sliding_m_per_s = velocity.now;
  now.sliding_m_per_s2 = velocity.per_s;
  now.added_stiffness_N_per_m = stiffness.now - scene.plant.stiffness_N_per_m;
  now.added_coefficient = coefficient.now - friction.coefficient;
  now.added_normal_force_N = normal_N.now - friction.normal_force_N;
  now.coefficient_per_s = coefficient.per_s;
  now.normal_force_N_per_s = normal_N.per_s;
  return now;
}

/// At the end of a scene, and the integral of F sgn(Vt).
struct Motion {
  double displacement_m;
  double velocity_m_per_s;
  double friction_force_N;
  double impulse_N_s;
};

/// From row to row of the profiles, and on to the end.
inline Motion by_peer(const scene::Scene& scene) {
  const scene::Plant& plant = scene.plant;
  const auto friction = make_equations(
      scene::name_of(scene.friction.law),
      {plant.mass_kg, plant.stiffness_N_per_m, plant.damping_N_s_per_m}, contact_of(scene));
  std::vector<double> joints = {0.0, scene.run.duration_s};
  const scene::TimedProfile sliding = sliding_of(scene);
  for (const scene::TimedProfile* profile :
       {&plant.stiffness_profile, &scene.friction.coefficient_profile,
        &scene.friction.normal_force_profile_N, &sliding}) {
    for (const scene::TimedValue& row : *profile) {
      joints.push_back(std::min(row.time_s, scene.run.duration_s));
    }
  }
  std::sort(joints.begin(), joints.end());
  State state{};
  state[0] = plant.initial_displacement_m;
  state[1] = plant.initial_velocity_m_per_s;
  double piece_s = 0.0;
  for (std::size_t i = 1; i < joints.size(); ++i) {
    if (!(joints[i] > joints[i - 1])) {
      continue;
    }
    piece_s = 0.5 * (joints[i - 1] + joints[i]);
    follow(
        *friction, [&](double time_s) { return instant(scene, sliding, time_s, piece_s); },
        joints[i - 1], joints[i], 1.0 / (700.0 * scene.drive->frequency_Hz), state);
  }
  return {state[0], state[1],
          friction->friction_N(state, instant(scene, sliding, joints.back(), piece_s)),
          state[impulse]};
}

}  // namespace sonoglide::equations
