/// What a force sensor shows of the vibration through the friction.
#pragma once

#include <array>
#include <complex>
#include <vector>

#include "host_sim/configure/nominal_plant.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::configure {

/// A contact under the velocity r + cos(2πt + phase), t in carrier periods from phase 0, in multiples
/// of the peak vibration velocity.
struct VibratedContact {
  double velocity_ratio;  ///< r, from above 0 to below 1
  double dahl_number;     ///< κ; infinite for Coulomb friction
  double phase;           ///< rad
};

/// Share of each time of a period in the answer of that period's mean friction, and in the next
/// period's; in those after it is less by `memory` from one to the next. In multiples of Fc and of the
/// peak vibration velocity, but for a common factor.
///
/// Dahl: the linearised equation over the periodic friction, exact for a velocity that is constant in
/// each of 256 cells; the two means are then within 1 % of the exact ones up to κ = 100. Above 150, and
/// for Coulomb friction, the answer is the sum over the two times at which the velocity is 0.
struct FrictionResponse {
  std::vector<double> time;
  std::vector<double> own;
  std::vector<double> next;
  double memory = 0.0;
};

FrictionResponse friction_response(const VibratedContact& contact);

/// Half the swing of the mean friction of a carrier period, over Fc, under a small free vibration whose
/// velocity has the amplitude of 1, in multiples of the peak vibration velocity.
/// Within 5 % of that of the contact itself up to κ = 20, within 12 % up to 150; exact for Coulomb friction.
/// @param turn  by which it turns in a carrier period, rad
double ratio_swing(const VibratedContact& contact, double turn);

/// A sensor of the mean friction: ρ' = fade ρ + fresh F + old F₋₁, and what takes its lag and that of
/// the contact away again (control::LaggingReading).
struct ReadingChain {
  double fade = 0.0;
  double fresh = 1.0;
  double old = 0.0;
  double contact_memory = 0.0;  ///< that is taken away
};

/// Of the vibration velocity that a reading stands for: what a velocity exp(λt) in the period itself,
/// in the one before and in all before that adds, and the same of the steady vibration cos(2πt +
/// phase); these add up to 1.
struct ReadingResponse {
  std::array<std::complex<double>, 3> mode;
  std::array<double, 3> forced{};
};

/// @param rate  λ, per carrier period
ReadingResponse reading_response(const VibratedContact& contact, std::complex<double> rate,
                                 const ReadingChain& chain);

/// What is the same for every frequency in the table.
struct FrictionReading {
  double speed = 0.0;   ///< fastest |Vt|, per unit
  double lambda = 0.0;  ///< Kt Vt/(ω Fc); infinite for Coulomb friction
  double sign = 1.0;    ///< of the vibration in the velocity along the sliding
  double noise = 0.0;   ///< of a lag-compensated ratio, rms
  double model_lift =
      0.0;  ///< by how much the compensation of the lag lifts what the model has wrong
  ReadingChain chain;

  VibratedContact contact(double ratio, double phase) const {
    return {ratio, lambda / ratio, phase};
  }
};

/// @param velocity_m_per_s  a velocity of 1, per unit
FrictionReading friction_reading(const scene::Scene& scene, const NominalPlant& plant,
                                 double velocity_m_per_s);

/// Rms of a reading, per sliding velocity.
double noise_of(double ratio, const FrictionReading& reading);

bool slides_backwards(const scene::Sliding& sliding);

}  // namespace sonoglide::configure
