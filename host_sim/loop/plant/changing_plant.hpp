/// A plant whose friction limit, spring or carrier frequency changes in time.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "host_sim/loop/plant/course.hpp"
#include "host_sim/loop/plant/energy.hpp"
#include "host_sim/loop/plant/held_plant.hpp"
#include "host_sim/loop/plant/plant_port.hpp"
#include "host_sim/loop/plant/snapshot.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

/// A spring whose stiffness changes in time. Stored energy and the spring's work are those of the stiffness of the moment, whatever the
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

  void copy_state(StateCopy& copy) { copy(reached_N_per_m_); }

 private:
  double mass_kg_;
  double reached_N_per_m_;  ///< at the end of the last stretch
};

/// Follows the profiles of a scene by plants in which nothing changes, one after the other.
///
/// The carrier frequency is that of each stretch. A jump acts where stretches meet.
///
/// A slope, of the friction or the spring, is followed in pieces: in each the values of its middle
/// hold, and SlopingContact leads what the contact remembers along the limit. This map is its own
/// inverse in reversed time, so that where the motion is smooth its error over a piece of length h
/// is c h^3 + d h^5 + ... With an adaptive solver a piece is taken in 1, 2, 3 ... parts, which are
/// extrapolated to parts of no length. Where two such results agree the last one is taken, else the
/// piece is shortened. About a reversal, a release or a slip, where the error is of first or second
/// order, the pieces so become as short as the tolerance asks for.
/// What agrees: the ends of the motion in its own size, the forces that the contact remembers and
/// the impulse of the friction, in 1/32 of the tolerance; forces in Fc, an impulse in Fc times the
/// carrier period. Fc is the largest limit of the scene. Three parts are the least, because about a
/// slip one and two of them may agree by chance.
/// Source: Hairer, Nørsett and Wanner, Solving Ordinary Differential Equations I, 2nd ed. 1993, II.9
/// (extrapolation, harmonic sequence, symmetric methods).
///
/// A solver of fixed steps takes the values of the middle of each step, and nothing is compared.
///
/// Sampling follows each sample from the beginning of its piece, beside the motion.
class ChangingPlant final : public PlantPort {
 public:
  /// @param scene  stretches end where its profiles have a row
  explicit ChangingPlant(const scene::Scene& scene);

  plant::Outcome<double> advance(const Stretch& stretch, EnergyBalance& energy) override {
    return follow(stretch, nullptr, energy);
  }
  plant::Outcome<double> advance_sampled(const Stretch& stretch,
                                         const std::vector<double>& offsets_s,
                                         EnergyBalance& energy,
                                         std::vector<PlantState>& seen) override {
    Sight sight{offsets_s, seen};
    return follow(stretch, &sight, energy);
  }
  std::vector<double> memory() const override { return held_.plant().memory(); }
  std::vector<double> memory_limits_N() const override { return held_.plant().memory_limits_N(); }
  void begin_at(const PlantState& state, const std::vector<double>& memory) override {
    held_.plant().begin_at(state, memory);
  }
  PlantState state() const override { return held_.plant().state(); }
  plant::Cost cost() const override;
  void copy_state(StateCopy& copy) override;

 private:
  /// Part of the solver's tolerance within which two results of a piece agree; what one
  /// carrier period collects in its pieces then stays below the tolerance.
  static constexpr double share_of_tolerance = 1.0 / 32.0;
  static constexpr int least_parts = 3;
  static constexpr int most_parts = 7;

  using Carried = HeldPlant::Carried;

  /// What a stretch shows.
  struct Sight {
    const std::vector<double>& offsets_s;
    std::vector<PlantState>& seen;
  };
  /// A stretch on a slope.
  struct Slope {
    const Stretch& stretch;
    const Course& course;
  };
  /// A part of it: from an offset on, with where it ends once that is known.
  struct Piece {
    double offset_s = 0.0;
    double length_s = 0.0;
    Carried end{};
    EnergyBalance energy{};
    std::uint64_t events = 0;
    plant::Outcome<double> outcome{};
  };

  /// A piece from several numbers of parts.
  struct Extrapolated {
    Piece piece;
    int parts;     ///< the last number
    double apart;  ///< from that of one number fewer, as a multiple of what is allowed
  };
  using Tableau = std::array<Piece, most_parts>;

  plant::Outcome<double> follow(const Stretch& stretch, Sight* sight, EnergyBalance& energy);
  plant::Outcome<double> hold_throughout(const Stretch& stretch, const Course& course, Sight* sight,
                                         EnergyBalance& energy);
  plant::Outcome<double> follow_slope(const Stretch& stretch, const Course& course, Sight* sight,
                                      EnergyBalance& energy);
  Piece in_steps(const Slope& slope, Sight* sight);
  Piece adapted(const Slope& slope, const Carried& begin, double offset_s, double length_s,
                Sight* sight);
  Piece taken(const Slope& slope, const Carried& begin, double offset_s, double length_s);
  Piece in_parts(const Slope& slope, const Carried& begin, double offset_s, double length_s,
                 int parts);
  Extrapolated extrapolated(const Slope& slope, const Carried& begin, double offset_s,
                            double length_s);
  static Piece joined(const Piece& first, const Piece& second);
  static void extrapolate(const Piece& coarse, double part, Piece& fine);
  static const Piece& extrapolate(Piece next, int parts, Tableau& row);
  double difference(const Piece& coarse, const Piece& fine) const;
  void look(const Slope& slope, const Carried& begin, const Piece& piece, Sight* sight);
  void arrive(const Slope& slope, const Carried& at, double offset_s);
  Held values(const Slope& slope, double offset_s) const;

  scene::Friction friction_;
  scene::Plant plant_;
  scene::Solver solver_;
  scene::PlantScales scales_;
  double largest_limit_N_;
  ChangingSpring spring_;
  double drive_rate_rad_per_s_;  ///< of the last stretch
  std::uint64_t tried_events_ = 0;
  HeldPlant held_;
};

}  // namespace sonoglide::loop
