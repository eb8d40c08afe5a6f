/// The plant seen from the simulation, in SI units, whatever it is composed of.
#pragma once

#include <memory>
#include <vector>

#include "firmware/plant/outcome.hpp"
#include "host_sim/loop/plant/energy.hpp"
#include "host_sim/loop/plant/snapshot.hpp"
#include "host_sim/loop/plant/step_meter.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

class UndrivenFriction;

/// A stretch of time in which amplitude and sliding velocity are linear, and the latter keeps its
/// sign. The drive is (drive_amplitude_N + drive_slope_N_per_rad θ) cos θ + drive_bias_N, θ its phase.
struct Stretch {
  double duration_s = 0.0;
  double drive_phase_rad = 0.0;           ///< at its beginning, in [0, 2π)
  double drive_rate_rad_per_s = 0.0;      ///< 2π f; 0 without a drive
  double drive_amplitude_N = 0.0;         ///< at phase 0
  double sliding_velocity_m_per_s = 0.0;  ///< at its beginning
  double sliding_acceleration_m_per_s2 = 0.0;
  /// The stretch lies within one straight piece of it.
  scene::Waveform drive_waveform = scene::Waveform::cosine;
  double drive_slope_N_per_rad = 0.0;  ///< of a cosine alone, as the next
  double drive_bias_N = 0.0;
  double begin_s = 0.0;        ///< since the run began: what changes in time is looked up by it
  bool demodulated = false;    ///< the account is to have velocity_in_phase_m and its quadrature
  bool energies = true;        ///< false: what depends on them is left open
  StepMeter* meter = nullptr;  ///< counts the steps
  /// With a load; the sliding velocity and its acceleration are then those of the pulled end of its spring.
  double load_force_N = 0.0;  ///< at the beginning
  double load_force_slope_N_per_s = 0.0;
  const UndrivenFriction* undriven = nullptr;  ///< null: Fc, at any speed
};

/// at_zero_N + slope_N_per_rad phase: of straight pieces the force, of a cosine its amplitude.
struct DrivePiece {
  double at_zero_N;
  double slope_N_per_rad;
  double phase_rad;  ///< at the beginning of the stretch
};

DrivePiece drive_piece(const Stretch& stretch);

/// Force of the drive at a time since the beginning of the stretch.
double drive_force_N(const Stretch& stretch, double offset_s);

struct PlantState {
  double displacement_m = 0.0;
  double velocity_m_per_s = 0.0;
  double friction_force_N = 0.0;
  double load_velocity_m_per_s = 0.0;  ///< 0 without a load, as the next
  double load_extension_m = 0.0;       ///< of its spring
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

  /// Of all that the motion goes on from, in a plant that was made for the same scene.
  virtual void copy_state(StateCopy& copy) = 0;
};

/// The plant of a scene, composed of exactly what the scene names, in its initial state.
std::unique_ptr<PlantPort> make_plant_port(const scene::Scene& scene);

}  // namespace sonoglide::loop
