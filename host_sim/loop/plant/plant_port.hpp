/// The plant seen from the simulation, in SI units, whatever it is composed of.
#pragma once

#include <vector>

#include "firmware/plant/outcome.hpp"
#include "host_sim/loop/plant/energy.hpp"
#include "host_sim/loop/plant/snapshot.hpp"
#include "host_sim/loop/plant/stretch.hpp"

namespace sonoglide::loop {

struct PlantState {
  double displacement_m;
  double velocity_m_per_s;
  double friction_force_N;
};

class PlantPort {
 public:
  virtual ~PlantPort() = default;

  /// Advances over one stretch. An error leaves the state where it happened, `outcome.offset`
  /// seconds into the stretch.
  /// @throws what the meter of the stretch throws; the state is that of the last step
  virtual plant::Outcome<double> advance(const Stretch& stretch, EnergyBalance& energy) = 0;

  /// The same motion, bit for bit. `seen` gets one state for each of the offsets, which rise and
  /// lie inside the stretch.
  virtual plant::Outcome<double> advance_sampled(const Stretch& stretch,
                                                 const std::vector<double>& offsets_s,
                                                 EnergyBalance& energy,
                                                 std::vector<PlantState>& seen) = 0;

  /// What the contact remembers of its past: numbers in [-1, 1], parts of the most that each can
  /// be. Empty where the velocity alone sets the force.
  virtual std::vector<double> memory() const = 0;

  /// The most that each of these numbers stands for, in N.
  virtual std::vector<double> memory_limits_N() const = 0;

  /// Puts the plant into a state; of a contact that remembers, the memory sets the force.
  virtual void begin_at(const PlantState& state, const std::vector<double>& memory) = 0;

  virtual PlantState state() const = 0;
  virtual plant::Cost cost() const = 0;

  /// All that the motion goes on from, in a plant that was made for the same scene.
  virtual void save(SnapshotWriter& state) const = 0;
  virtual void restore(SnapshotReader& state) = 0;
};

}  // namespace sonoglide::loop
