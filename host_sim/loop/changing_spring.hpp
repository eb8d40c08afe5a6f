/// A spring whose stiffness changes in time.
#pragma once

#include <limits>

#include "host_sim/loop/energy.hpp"
#include "host_sim/loop/plant_port.hpp"
#include "host_sim/loop/snapshot.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

/// A slope is followed in pairs of equal pieces, in each a stiffness that holds. In a pair of length
/// H about a middle where the stiffness is k, with the slope s, they are k - s H/3 and k + s H/3:
/// the commutator-free Magnus method of fourth order. Its error in a period of the fastest rate w
/// is below c (2 pi/p)^4 / 2880 of the motion, for p pairs a period and a stiffness that changes by
/// the part c of itself in one. Where a contact sticks, the stiffness of a piece shifts its release,
/// and the error is of second order in H.
///
/// Stored energy and the spring's work are those of the stiffness of the moment, so that the
/// residual of the energy identity shows what the pieces miss.
///
/// Source: S. Blanes, P. C. Moan, Fourth- and sixth-order commutator-free Magnus integrators for
/// linear and non-linear dynamical systems, Applied Numerical Mathematics 56 (2006) 1519-1537.
class ChangingSpring {
 public:
  /// Of the motion, in a period of the fastest rate.
  static constexpr double largest_error = 1e-10;

  explicit ChangingSpring(const scene::Scene& scene);

  /// The stiffness over a stretch, in which the profile has no row.
  struct Line {
    double middle_N_per_m;
    double slope_N_per_m_s;

    double at(double offset_from_middle_s) const {
      return middle_N_per_m + slope_N_per_m_s * offset_from_middle_s;
    }
  };
  Line over(const Stretch& stretch) const;

  /// The most pieces that a slope takes in a stretch; 0 where there is no slope.
  double pieces(const Stretch& stretch, const Line& line) const;
  /// Of the even number `count` of equal pieces of the stretch.
  static double held_N_per_m(const Stretch& stretch, const Line& line, double index, double count);

  /// Puts the energies of the stiffness of the moment in place of those of the pieces.
  /// @param energy         of a stretch in `count` pieces
  /// @param begin_m, end_m  displacements
  void settle(const Stretch& stretch, const Line& line, double count, double begin_m, double end_m,
              EnergyBalance& energy);

  void save(SnapshotWriter& state) const { state.put(reached_N_per_m_); }
  void restore(SnapshotReader& state) { state.get(reached_N_per_m_); }

 private:
  scene::TimedProfile profile_;
  double constant_N_per_m_;
  double mass_kg_;
  double contact_stiffness_N_per_m_;
  double reached_N_per_m_;  ///< at the end of the last stretch
};

}  // namespace sonoglide::loop
