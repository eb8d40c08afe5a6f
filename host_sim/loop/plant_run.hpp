/// The plant along the time axis of a run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "host_sim/loop/electrical.hpp"
#include "host_sim/loop/force_sampler.hpp"
#include "host_sim/loop/plant/carrier_grid.hpp"
#include "host_sim/loop/plant/course.hpp"
#include "host_sim/loop/plant/energy.hpp"
#include "host_sim/loop/plant/period_drive.hpp"
#include "host_sim/loop/plant/plant_port.hpp"
#include "host_sim/loop/plant/sliding_profile.hpp"
#include "host_sim/loop/plant/step_meter.hpp"
#include "host_sim/loop/plant/undriven_friction.hpp"
#include "host_sim/loop/run_result.hpp"
#include "host_sim/loop/sampler.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

class PlantRun {
 public:
  /// Energies and final values go into the result. All must outlive it.
  /// @throws ComputationError  the steady orbit that the run is to begin on cannot be found
  PlantRun(const scene::Scene& scene, const CarrierClock& clock, const Watch& watch,
           RunResult& result);

  /// Where the last call of advance() ended.
  double sliding_velocity_m_per_s() const;
  /// Of a load, since the run began; 0 without one.
  double load_displacement_m() const;

  /// On a load from here on, beside that of its profile.
  void set_load_force_N(double force_N) { added_load_force_N_ = force_N; }

  /// Advances over the carrier period of the clock, under one drive amplitude, to which that of the
  /// period before passes as the scene says.
  /// @param bias_N  force that is constant over the period; 0 unless the scene has a bias limit
  /// @throws ComputationError
  EnergyBalance advance(double amplitude_N, double bias_N = 0.0);

  /// Of the last call of advance().
  const std::vector<double>& force_samples_N() const { return force_.samples_N(); }

  /// In the last call of advance().
  const PeriodDrive& drive() const { return drive_; }

  /// Now, where the last call of advance() ended.
  PlantState state() const { return plant_->state(); }

  /// Of all that the motion goes on from, but for the clock and the samples that a watch wants.
  void copy_state(StateCopy& copy);

  /// Fills in what the run ends with.
  void finish();

 private:
  void piece(double begin_s, double from_s, double until_s, double end_s, const DrivePart& drive,
             EnergyBalance& total);
  EnergyBalance stretch(double begin_s, double duration_s, double drive_phase_rad, double end_s,
                        const DrivePart& drive);
  plant::Outcome<double> solve(double begin_s, double end_s, const Stretch& stretch,
                               EnergyBalance& energy);
  Line load_force(double begin_s, double duration_s) const;
  void note_peaks(double end_s, const EnergyBalance& period);
  bool in_window(double begin_s) const;
  [[noreturn]] void fail(plant::Error error, double time_s) const;

  const scene::Scene& scene_;
  const CarrierClock& clock_;
  RunResult& result_;
  StepMeter meter_;
  std::unique_ptr<PlantPort> plant_;
  SlidingProfile sliding_;
  UndrivenFriction undriven_;
  scene::Waveform waveform_;
  bool energies_;
  double given_velocity_m_per_s_;  ///< of the sliding, or of the pulled end of a load's spring
  double pulled_m_ = 0.0;          ///< its integral since the run began
  double added_load_force_N_ = 0.0;
  bool load_slides_ = true;  ///< one way in all of the last period; true without a load or drive
  PeriodDrive drive_;        ///< of the last period
  ForceSampler force_;
  std::vector<double> cuts_s_;  ///< times inside carrier periods at which a stretch must end
  std::size_t next_cut_ = 0;
  Sampler sampler_;
  std::vector<PlantState> seen_;
};

}  // namespace sonoglide::loop
