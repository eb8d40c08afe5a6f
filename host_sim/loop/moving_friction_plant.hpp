/// A plant whose friction limit changes in time.
#pragma once

#include <memory>
#include <vector>

#include "host_sim/loop/plant_port.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

/// Follows the profiles of a scene's friction by plants whose limit holds, one after the other.
///
/// Displacement and velocity go over from one to the next, and so do the contact's forces, in
/// newtons; what is above a new limit is cut to it, so that |F| <= Fc(t) of a law with that bound.
/// A cut takes from what the contact has stored, not from the oscillator: the energy identity,
/// whose friction work is the integral of F V dt, holds across it.
///
/// A slope is followed in equal pieces, in each the limit of its middle. What a piece of length h
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
class MovingFrictionPlant final : public PlantPort {
 public:
  /// In friction ratio, of a carrier period on a slope.
  static constexpr double largest_ratio_error = 1e-7;

  /// @param scene  whose friction changes; stretches end where its profiles have a row
  explicit MovingFrictionPlant(const scene::Scene& scene);

  plant::Outcome<double> advance(const Stretch& stretch, EnergyBalance& energy) override {
    return follow(stretch, nullptr, energy);
  }
  plant::Outcome<double> advance_sampled(const Stretch& stretch,
                                         const std::vector<double>& offsets_s,
                                         EnergyBalance& energy,
                                         std::vector<PlantState>& seen) override;
  std::vector<double> memory() const override { return held_->memory(); }
  std::vector<double> memory_limits_N() const override { return held_->memory_limits_N(); }
  void begin_at(const PlantState& state, const std::vector<double>& memory) override {
    held_->begin_at(state, memory);
  }
  PlantState state() const override { return within_limit(held_->state(), time_s_); }
  plant::Cost cost() const override;

 private:
  /// What goes over from one plant to the next.
  struct Carried {
    PlantState state;
    std::vector<double> forces_N;  ///< that the contact remembers
  };
  /// What a stretch shows, on its way through the pieces.
  struct Sight {
    const std::vector<double>& offsets_s;
    std::vector<PlantState>& seen;
    double begin_s = 0.0;
    std::size_t next = 0;
  };

  plant::Outcome<double> follow(const Stretch& stretch, Sight* sight, EnergyBalance& energy);
  plant::Outcome<double> follow_piece(const Stretch& piece, const Carried& begin, int halvings,
                                      bool last, Sight* sight, EnergyBalance& energy);
  plant::Outcome<double> hold_piece(const Stretch& piece, bool last, Sight* sight,
                                    EnergyBalance& energy);
  double pieces_per_period(const Stretch& stretch) const;
  Carried carried() const;
  void put(const Carried& from);
  void hold(const scene::ContactValues& contact, const Carried& from);
  PlantState within_limit(PlantState state, double time_s) const;

  scene::Friction friction_;
  scene::Scene scene_;  ///< its friction as it is held now
  scene::SolverMethod asked_method_;
  scene::SolverMethod method_;  ///< of the stretch
  double reversing_s_;          ///< in which V reverses twice
  double time_s_ = 0.0;
  plant::Cost spent_;  ///< by the plants before this one
  std::unique_ptr<PlantPort> held_;
};

}  // namespace sonoglide::loop
