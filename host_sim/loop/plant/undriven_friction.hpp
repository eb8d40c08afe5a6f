/// What the slide of a scene would meet without vibration.
#pragma once

#include "host_sim/loop/plant/energy.hpp"
#include "host_sim/loop/plant/plant_port.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

/// The friction F0(t) that a steady slide at the speed of the moment would meet at the friction of
/// the moment: what friction ratios are relative to.
class UndrivenFriction {
 public:
  explicit UndrivenFriction(const scene::Scene& scene);

  /// Fills in undriven_s and limit_distance_m of the account of a stretch.
  /// Error: exact where F0 is a polynomial of the time; of a LuGre contact whose speed passes 10
  /// Stribeck velocities within the stretch 1e-9 of the largest.
  /// With a load the plant has filled in undriven_s itself.
  void complete(const Stretch& stretch, EnergyBalance& energy) const;

  /// F0 is Fc throughout.
  bool is_limit() const { return is_limit_; }
  /// F0/Fc at a sliding velocity, of a contact that does not change.
  double part_at(double sliding_m_per_s) const {
    return part_of_largest(friction_, sliding_m_per_s);
  }

 private:
  double part_of_largest(const scene::ContactValues& contact, double sliding_m_per_s) const;
  void follow(const Stretch& stretch, EnergyBalance& energy) const;

  scene::Friction friction_;
  double largest_N_;
  bool is_limit_;
  bool has_load_;
};

}  // namespace sonoglide::loop
