/// A contact whose friction limit changes while a plant holds the limit of the middle.
#pragma once

#include <vector>

#include "host_sim/loop/plant/energy.hpp"
#include "host_sim/loop/plant/held_plant.hpp"
#include "host_sim/loop/plant/plant_port.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

/// A piece of a slope of the friction limit q. Its plant has the limit of its middle, so that the
/// force of a contact without a memory errs by nothing in the mean, and the motion by O(length^3).
/// What a contact remembers would begin and end under that limit. So:
///
/// - A force at its limit stays there while it would rise faster by itself: a slider, of Iwan or of
///   normal vibration, by the load of its spring, bristles by dF/dt = Kt (V - |V| F/G). It begins at
///   the limit of the plant and ends at that of the moment; the impulse is made that of q(t).
/// - Bristles, of Dahl or LuGre, relax towards the limit, by the part 1 - exp(-a) over the piece,
///   a = Kt |du|/G, G the friction of the steady slide. Along a limit of slope s they end at the
///   force that the plant gives plus
///     dF = s h (1/2 + exp(-a)/2 - (1 - exp(-a))/a),
///   the solution of dF/dt = (a/h)(q(t) - F). Their impulse lacks dF h/a, the lag behind a limit
///   that rises: without this, pieces far longer than the lag h/a would all err alike.
/// - No force ends above its limit at the end: what a falling limit leaves above it is cut off.
class SlopingContact {
 public:
  struct Limits {
    scene::ContactValues begin;
    scene::ContactValues middle;
    scene::ContactValues end;
  };

  /// @param piece  of which the plant will be advanced; outlives this, and so does `friction`
  SlopingContact(const scene::Friction& friction, double mass_kg, const Limits& limits,
                 const Stretch& piece)
      : friction_(friction), mass_kg_(mass_kg), limits_(limits), piece_(piece) {}

  /// @param plant  at the beginning of the piece, with the limits of the middle
  void set_out(const HeldPlant::Carried& begin, PlantPort& plant);

  /// @param plant   at the end of the piece
  /// @param energy  of the piece
  HeldPlant::Carried arrive(const PlantState& begin, const PlantPort& plant,
                            EnergyBalance& energy) const;

 private:
  /// A force that the contact remembers, where the piece begins.
  struct Begun {
    double force_N;
    double own_N;    ///< its limit
    double plant_N;  ///< that of the plant
    bool stays;      ///< at its limit
  };

  double moved_limit_N(double limit_N, const scene::ContactValues& to) const;
  bool stays_at_limit(double force_N, double limit_N, double sliding_m_per_s,
                      double velocity_m_per_s) const;
  double steady_N(const scene::ContactValues& contact, double contact_m_per_s) const;
  double lead(const Begun& begun, const PlantState& begin, const PlantState& end, double plant_N,
              double& force_N) const;
  double load(const Begun& begun, const PlantState& begin, const PlantState& end, double plant_N,
              double& force_N) const;
  double loading_N_per_s(const PlantState& begin, const PlantState& end) const;
  double lag(const Begun& begun, const PlantState& begin, const PlantState& end,
             double& force_N) const;
  void add_impulse(double impulse_N_s, const PlantState& begin, PlantState& end,
                   EnergyBalance& energy) const;
  double mean_sliding_m_per_s() const;
  double contact_velocity_m_per_s(double sliding_m_per_s, double velocity_m_per_s) const;
  double mean_contact_m_per_s(const PlantState& begin, const PlantState& end) const;

  const scene::Friction& friction_;
  double mass_kg_;
  Limits limits_;
  const Stretch& piece_;
  std::vector<Begun> begun_;
};

}  // namespace sonoglide::loop
