/// A spring whose stiffness changes in time.
#pragma once

#include "host_sim/loop/plant/course.hpp"
#include "host_sim/loop/plant/energy.hpp"
#include "host_sim/loop/plant/plant_port.hpp"
#include "host_sim/loop/plant/snapshot.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

/// Stored energy and the spring's work are those of the stiffness of the moment, whatever the
/// stiffness of the pieces in which a slope is followed: the residual of the energy identity shows
/// what they miss.
class ChangingSpring {
 public:
  explicit ChangingSpring(const scene::Scene& scene)
      : mass_kg_(scene.plant.mass_kg), reached_N_per_m_(scene.plant.stiffness_N_per_m) {}

  /// Puts the energies of the stiffness of the moment in place of those of the pieces.
  /// @param energy      of a stretch
  /// @param begin, end  of the stretch
  void settle(const Course& course, const PlantState& begin, const PlantState& end,
              EnergyBalance& energy);

  void save(SnapshotWriter& state) const { state.put(reached_N_per_m_); }
  void restore(SnapshotReader& state) { state.get(reached_N_per_m_); }

 private:
  double mass_kg_;
  double reached_N_per_m_;  ///< at the end of the last stretch
};

}  // namespace sonoglide::loop
