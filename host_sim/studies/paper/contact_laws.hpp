/// The friction laws that the program has, as contacts of Table 1.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "host_sim/scene/scene.hpp"

namespace sonoglide::paper {

/// mu(v) = mu_s sgn v - alpha v + beta v^3 with its least value (1 - drop) mu_s at v_m:
///   alpha v_m / mu_s = 3/2 drop,  beta v_m^3 / mu_s = 1/2 drop.
struct StribeckShape {
  double drop;       ///< [-]
  double vibration;  ///< peak vibration velocity / v_m [-]
};

/// Mean friction under a sinusoidal vibration over that without at the same speed.
/// @param velocity_ratio  Vt / peak vibration velocity [-]
double stribeck_vibration_ratio(double velocity_ratio, const StribeckShape& shape);

struct ContactLaw {
  std::string name;     ///< for the key
  std::string column;   ///< for a column and a file
  std::string contact;  ///< the [friction] table's keys
  /// Mean friction under a sinusoidal vibration over that without at the same speed, of the
  /// velocity ratio; absent where no closed form is known.
  std::function<double(double)> closed_form;

  std::string scene_file() const;
  std::string scene_text() const;
};

const std::vector<ContactLaw>& contact_laws();

/// The friction ratio over the scene's window.
/// @throws loop::ComputationError
double vibration_ratio(const scene::Scene& scene);

/// vibration_ratio() of a law over velocity_ratios(), on every core.
std::vector<double> simulated_ratios(const ContactLaw& law);

}  // namespace sonoglide::paper
