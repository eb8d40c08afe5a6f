#include "host_sim/studies/stability/random_scene.hpp"

#include <string>

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/turn.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/studies/splitmix64.hpp"
#include "host_sim/studies/stability/settings.hpp"

namespace sonoglide::stability {
namespace {

constexpr double ln_10 = 2.302585092994045684018;

/// A stream of splitmix64 for each number.
class Dice {
 public:
  explicit Dice(std::uint64_t number) : state_(studies::mixed(number)) {}

  /// [0, 1), 53 bits.
  double uniform() {
    state_ += studies::splitmix64_step;
    return static_cast<double>(studies::mixed(state_) >> 11U) * 0x1p-53;
  }
  bool chance(double probability) { return uniform() < probability; }
  double sign() { return chance(0.5) ? 1.0 : -1.0; }
  /// 10^x, x uniform. The core's exponential has the same bits on every machine.
  double decades(double low_exponent, double high_exponent) {
    return numeric::exp(ln_10 * (low_exponent + (high_exponent - low_exponent) * uniform()));
  }
  double decades_or_zero(double zero_probability, double low_exponent, double high_exponent) {
    const double value = decades(low_exponent, high_exponent);
    return chance(zero_probability) ? 0.0 : value;
  }

 private:
  std::uint64_t state_;
};

void draw_plant(Dice& dice, double frequency_Hz, scene::Plant& plant) {
  const double omega = numeric::two_pi * frequency_Hz;
  plant.mass_kg = dice.decades(-9.0, 3.0);
  plant.stiffness_N_per_m = dice.decades_or_zero(0.1, -6.0, 15.0);
  if (dice.chance(0.05)) {
    plant.stiffness_N_per_m = plant.mass_kg * omega * omega;
  }
  const double rate = plant.stiffness_N_per_m > 0.0 ? plant.natural_rad_per_s() : omega;
  plant.damping_N_s_per_m = 2.0 * plant.mass_kg * rate * dice.decades_or_zero(0.4, -6.0, 2.0);
  plant.initial_displacement_m = dice.sign() * dice.decades_or_zero(0.6, -15.0, 0.0);
  plant.initial_velocity_m_per_s = dice.sign() * dice.decades_or_zero(0.6, -9.0, 3.0);
}

scene::FrictionLaw draw_law(Dice& dice) {
  const double drawn = dice.uniform();
  int percent = 0;
  for (const LawShare& share : random_laws) {
    percent += share.percent;
    if (drawn < percent / 100.0) {
      return share.law;
    }
  }
  return scene::laws::None{};
}

void draw_friction(Dice& dice, scene::Friction& friction) {
  friction.law = draw_law(dice);
  if (scene::is<scene::laws::None>(friction.law)) {
    return;
  }
  friction.coefficient = dice.decades_or_zero(0.05, -6.0, 1.0);
  friction.normal_force_N = dice.decades_or_zero(0.05, -9.0, 6.0);
  friction.sign_convention =
      dice.chance(0.25) ? scene::SignConvention::as_printed : scene::SignConvention::dissipative;
  if (scene::is_elastic(friction.law)) {
    friction.contact_stiffness_N_per_m = dice.decades(-3.0, 13.0);
    const double part = dice.chance(0.5) ? 0.0 : dice.chance(0.2) ? 1.0 : dice.uniform();
    friction.initial_force_N = dice.sign() * part * friction.limit_N();
  }
}

void draw_sliding(Dice& dice, double duration_s, scene::Sliding& sliding) {
  const double velocity = dice.sign() * dice.decades_or_zero(0.1, -9.0, 3.0);
  sliding.profile = {{0.0, velocity}};
  if (dice.chance(0.2)) {
    sliding.profile.push_back({duration_s, 2.0 * dice.uniform() * velocity});
  }
}

}  // namespace

scene::Scene random_scene(std::uint64_t number) {
  Dice dice(number);
  scene::Scene scene;
  scene.name = "random_" + std::to_string(number);
  const double frequency_Hz = dice.decades(0.0, 7.0);
  draw_plant(dice, frequency_Hz, scene.plant);
  draw_friction(dice, scene.friction);
  scene.run.duration_s = random_scene_periods / frequency_Hz;
  const double amplitude_N = dice.decades_or_zero(0.1, -9.0, 9.0);
  if (!dice.chance(0.1)) {
    scene.drive = scene::Drive{};
    scene.drive->frequency_Hz = frequency_Hz;
    scene.drive->force_amplitude_N = amplitude_N;
  } else {
    // The clock is then the plant's own.
    const double omega = configure::plant_scales(scene).angular_frequency_rad_per_s;
    scene.run.duration_s = random_scene_periods * numeric::two_pi / omega;
  }
  draw_sliding(dice, scene.run.duration_s, scene.sliding);
  return scene;
}

}  // namespace sonoglide::stability
