/// Random scenes of any law, the same on every machine.
#pragma once

#include <cmath>
#include <variant>

#include "host_sim/scene/scene.hpp"
#include "tests/common/constants/pi.hpp"
#include "tests/common/dice/dice.hpp"

namespace sonoglide::tests {

/// What the draw of a law's own keys is in proportion to.
struct Sizes {
  double displacement_m;
  double velocity_m_per_s;
  double friction_N;
  double normal_N;
};

/// One call for each law: one that is added is drawn here as well, or this does not compile.
class OwnKeys {
 public:
  OwnKeys(Dice& dice, const Sizes& sizes) : dice_(dice), sizes_(sizes) {}

  void operator()(scene::laws::None& /*law*/) const {}
  void operator()(scene::laws::Coulomb& /*law*/) const {}
  void operator()(scene::laws::Dahl& /*law*/) const {}
  void operator()(scene::laws::TransverseCoulomb& /*law*/) const {}
  void operator()(scene::laws::Iwan& law) const {
    law.elements = 1 + static_cast<int>(dice_.between(0.0, 8.0));
  }
  void operator()(scene::laws::LuGre& law) const {
    const double damping = sizes_.friction_N / sizes_.velocity_m_per_s;
    law.static_coefficient = coefficient * dice_.between(1.0, 2.0);
    law.stribeck_velocity_m_per_s = sizes_.velocity_m_per_s * dice_.decades(0.03, 1.0);
    law.bristle_damping_N_s_per_m = damping * dice_.between(0.0, 0.3);
    law.viscous_friction_N_s_per_m = damping * dice_.between(0.0, 0.3);
  }
  void operator()(scene::laws::Stribeck& law) const {
    law.fall_s_per_m = coefficient / sizes_.velocity_m_per_s * dice_.between(0.0, 0.5);
    law.rise_s3_per_m3 = 4.0 / 27.0 * std::pow(law.fall_s_per_m, 3) / (coefficient * coefficient) *
                         dice_.between(1.0, 3.0);
  }
  void operator()(scene::laws::NormalCoulomb& law) const {
    law.normal_contact_stiffness_N_per_m =
        sizes_.normal_N / sizes_.displacement_m * dice_.decades(0.05, 1.5);
  }

  static constexpr double coefficient = 0.1;

 private:
  Dice& dice_;
  Sizes sizes_;
};

/// A spring, or none; the natural mode then on either side of the carrier, clear of resonance.
inline scene::Scene random_scene(Dice& dice, const scene::FrictionLaw& law, bool has_spring,
                                 int periods) {
  scene::Scene scene;
  scene.drive.emplace();
  scene.drive->frequency_Hz = dice.decades(18e3, 120e3);
  const double omega = two_pi * scene.drive->frequency_Hz;
  scene.plant.mass_kg = dice.decades(1e-3, 1.0);
  const double inertia_N_per_m = scene.plant.mass_kg * omega * omega;
  const double mode = dice.chance(0.7) ? dice.between(0.15, 0.9) : dice.between(1.15, 3.0);
  scene.plant.stiffness_N_per_m = has_spring ? mode * mode * inertia_N_per_m : 0.0;
  const double damping = dice.decades(1e-4, 0.1) * scene.plant.mass_kg * omega;
  scene.plant.damping_N_s_per_m = dice.chance(0.5) ? damping : 0.0;

  Sizes sizes{};
  sizes.velocity_m_per_s = dice.decades(5e-3, 0.5);
  sizes.displacement_m = sizes.velocity_m_per_s / omega;
  sizes.friction_N = dice.decades(1e-6, 0.3) * inertia_N_per_m * sizes.displacement_m;
  sizes.normal_N = sizes.friction_N / OwnKeys::coefficient;
  scene.drive->force_amplitude_N =
      (scene.plant.stiffness_N_per_m + inertia_N_per_m) * sizes.displacement_m;

  scene.friction.law = law;
  scene.friction.coefficient = OwnKeys::coefficient;
  scene.friction.normal_force_N = sizes.normal_N;
  scene.friction.contact_stiffness_N_per_m =
      dice.decades(0.03, 100.0) * sizes.friction_N / sizes.displacement_m;
  std::visit(OwnKeys(dice, sizes), scene.friction.law);

  scene.run.duration_s = periods / scene.drive->frequency_Hz;
  const double first = dice.between(0.05, 1.2) * sizes.velocity_m_per_s;
  const double last = dice.between(0.05, 1.2) * sizes.velocity_m_per_s;
  scene.sliding.profile = {{0.0, first}};
  if (dice.chance(0.5)) {
    scene.sliding.profile.push_back({scene.run.duration_s, last});
  }
  return scene;
}

}  // namespace sonoglide::tests
