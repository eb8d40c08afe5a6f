/// A plant whose friction limit, spring or carrier frequency changes in time.
#pragma once

#include <cstddef>
#include <vector>

#include "host_sim/loop/changing_spring.hpp"
#include "host_sim/loop/held_plant.hpp"
#include "host_sim/loop/plant_port.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

/// Follows the profiles of a scene by plants in which nothing changes, one after the other.
///
/// The carrier frequency is that of each stretch. A slope of the spring is followed in pieces, see
/// ChangingSpring.
///
/// A friction force above a new limit is cut to it, so that |F| <= Fc(t) of a law with that bound.
/// A cut takes from what the contact has stored, not from the oscillator: the energy identity,
/// whose friction work is the integral of F V dt, holds across it.
///
/// A slope of the limit is followed in equal pieces, in each the limit of its middle. What a piece of length h
/// misses of the limit, s (t - middle), has the integral s (t - begin)(t - end)/2, at most s h^2/8,
/// which is nothing at its ends. The limit enters the mean friction with a weight (sgn V under
/// Coulomb friction) whose variation is at most 4 in a period with two reversals, so that the mean
/// over a period T errs by at most s h^2/(2 T): c/(2 n^2) of Fc for n pieces a period and a limit
/// that changes by the part c of itself in one.
/// A limit that comes down takes the contact's force with it, also where the contact moves back so
/// slowly that the force alone would fall less: there the piece has a limit that is higher by half
/// of what the force loses in it, so that its mean is the middle's. Where the contact moves back
/// faster the force leaves the limit, and what it was then, up to s h/2 wrong, is remembered until
/// the contact has slid on, twice a period. Such a piece is halved, and again the half in which the
/// force leaves, to 1/(2 n) of a piece at most: c/(2 n^2) of Fc again, where the memory fades
/// within a period.
/// n = sqrt(c/largest_ratio_error) keeps both together below that; Fc is that at the higher end of
/// the slope.
class ChangingPlant final : public PlantPort {
 public:
  /// In friction ratio, of a carrier period on a slope of the friction.
  static constexpr double largest_ratio_error = 1e-7;

  /// @param scene  stretches end where its profiles have a row
  explicit ChangingPlant(const scene::Scene& scene);

  plant::Outcome<double> advance(const Stretch& stretch, EnergyBalance& energy) override {
    return follow(stretch, nullptr, energy);
  }
  plant::Outcome<double> advance_sampled(const Stretch& stretch,
                                         const std::vector<double>& offsets_s,
                                         EnergyBalance& energy,
                                         std::vector<PlantState>& seen) override;
  std::vector<double> memory() const override { return held_.plant().memory(); }
  std::vector<double> memory_limits_N() const override { return held_.plant().memory_limits_N(); }
  void begin_at(const PlantState& state, const std::vector<double>& memory) override {
    held_.plant().begin_at(state, memory);
  }
  PlantState state() const override { return within_limit(held_.plant().state(), time_s_); }
  plant::Cost cost() const override { return held_.cost(); }
  void save(SnapshotWriter& state) const override;
  void restore(SnapshotReader& state) override;

 private:
  /// What a stretch shows, on its way through the pieces.
  struct Sight {
    const std::vector<double>& offsets_s;
    std::vector<PlantState>& seen;
    double begin_s = 0.0;
    std::size_t next = 0;
  };
  /// A part of a stretch. The spring holds in it, and the friction in parts of it.
  struct Piece {
    Stretch stretch;
    double stiffness_N_per_m = 0.0;
    scene::SolverMethod method;
    bool last = false;  ///< of the stretch
  };

  plant::Outcome<double> follow(const Stretch& stretch, Sight* sight, EnergyBalance& energy);
  plant::Outcome<double> follow_friction(const Piece& piece, const HeldPlant::Carried& begin,
                                         int halvings, Sight* sight, EnergyBalance& energy);
  plant::Outcome<double> halve(const Piece& piece, const HeldPlant::Carried& begin, int halvings,
                               Sight* sight, EnergyBalance& energy);
  plant::Outcome<double> advance_piece(const Piece& piece, Sight* sight, EnergyBalance& energy);
  void hold(const Piece& piece, const scene::ContactValues& contact,
            const HeldPlant::Carried& from);
  double friction_pieces_per_period(const Stretch& stretch) const;
  PlantState within_limit(PlantState state, double time_s) const;

  scene::Friction friction_;
  ChangingSpring spring_;
  scene::SolverMethod asked_method_;
  double reversing_s_;           ///< in which V reverses twice
  double drive_rate_rad_per_s_;  ///< of the last stretch
  double time_s_ = 0.0;
  HeldPlant held_;
};

}  // namespace sonoglide::loop
