/// The inverse friction-ratio map of a law, tabulated for a controller.
#pragma once

#include <optional>

#include "firmware/friction/inverse_table.hpp"
#include "host_sim/configure/nominal_plant.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::configure {

/// A table for control::TabulatedFeedforward. Its rows are those of u = λ at a ratio of 1:
///   u = Vt/reference · (nominal friction/friction that is learnt),
/// the second factor where `over_force`.
struct InverseDesign {
  friction::InverseTable table{};
  double reference_m_per_s = 1.0;
  double reach = 1.0;
  friction::InverseForm form = friction::InverseForm::over_ratio;
  bool over_force = false;
  /// At the fastest sliding, where no vibration gives less, however strong the drive.
  std::optional<double> least_ratio = std::nullopt;
};

/// The law is one whose map is tabulated, and there are friction and sliding.
bool is_tabulated(const scene::Scene& scene);

/// Peak velocity that the nominal contact needs at the fastest sliding, without a table; as below.
/// @param friction_ratio  below 1
/// @pre  is_tabulated(scene)
double required_vibration_m_per_s(const scene::Scene& scene, const NominalPlant& plant,
                                  double friction_ratio);

/// Of the nominal contact under a sinusoidal vibration at the carrier frequency. For a ratio that more than
/// one vibration gives it has the smallest of them, for one that none gives the vibration that comes nearest.
///
/// The friction depends on the sliding speed and on the friction level. Where the speed of the scene is
/// constant, and where a law knows the two by their quotient alone (iwan), rows are levels from half to
/// twice the nominal one, of a law that yields before it slides and a level that is learnt. Elsewhere
/// rows are speeds, from the fastest of the scene to 1/128 of it, at the nominal level. Beyond, the
/// outermost row holds.
///
/// A level that is another is a normal force that is another; under normal vibration a coefficient.
///
/// @pre  is_tabulated(scene)
/// Error: 0.003 in friction ratio at the nominal level, within the rows 0.005, for ratios of 0.05 to 1,
/// and that of the law's closed form; see InverseDesignTest.
InverseDesign design_inverse(const scene::Scene& scene, const NominalPlant& plant);

}  // namespace sonoglide::configure
