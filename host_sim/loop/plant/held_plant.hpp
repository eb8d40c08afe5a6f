/// A plant in which nothing changes for a while, and which hands its state on when it does.
#pragma once

#include <memory>
#include <vector>

#include "host_sim/loop/plant/plant_port.hpp"
#include "host_sim/loop/plant/snapshot.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

/// What holds for a while of all that may change.
struct Held {
  scene::ContactValues contact;
  double stiffness_N_per_m = 0.0;
  double drive_rate_rad_per_s = 0.0;  ///< 2π f; 0 without a drive
  scene::SolverMethod method;
  double tolerance = 0.0;  ///< of the solver
};

/// The plant of a scene whose friction limit, spring, carrier frequency and solver hold. After a
/// change another takes its place. Displacement and velocity go over from one to the next, and so
/// do the contact's forces, in newtons; what is above a new limit is cut to it.
class HeldPlant {
 public:
  /// What goes over.
  struct Carried {
    PlantState state;
    std::vector<double> forces_N;  ///< that the contact remembers
  };

  /// As the scene is at 0 s.
  explicit HeldPlant(const scene::Scene& scene);

  /// From here on; without a change nothing happens, not even to the state.
  void hold(const Held& wanted, const Carried& from);
  /// The same with a new plant, change or not, so that nothing of what was solved before matters.
  void begin(const Held& wanted, const Carried& from);

  Carried carried() const;
  /// The contact's forces as far as the limits let them.
  void put(const Carried& from);

  PlantPort& plant() { return *plant_; }
  const PlantPort& plant() const { return *plant_; }
  /// Of this plant and of those before it.
  plant::Cost cost() const;
  /// As if no more had been spent until now.
  void set_cost(const plant::Cost& cost);

  void copy_state(StateCopy& copy);

 private:
  void make(const Held& wanted);

  scene::Scene scene_;
  double drive_rate_rad_per_s_;
  plant::Cost spent_;  ///< by the plants before this one
  std::unique_ptr<PlantPort> plant_;
};

}  // namespace sonoglide::loop
