/// A scene's plant, its controller or both, advanced by carrier periods: run() steps it from inside,
/// a SteppedScene from outside, and of loops in lanes the controllers alone.
#pragma once

#include <optional>

#include "host_sim/configure/control_design.hpp"
#include "host_sim/loop/control_run.hpp"
#include "host_sim/loop/plant/carrier_grid.hpp"
#include "host_sim/loop/plant_run.hpp"
#include "host_sim/loop/run_result.hpp"
#include "host_sim/loop/watch.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

/// A carrier period as the controller and those who watch see it.
struct PlantPeriod : Period {
  double mean_friction_force_N = 0.0;
  double mean_velocity_m_per_s = 0.0;  ///< of the vibration; 0 where no bias answers it
};

/// A result to be filled in; with a controller of this design.
RunResult begun_result(const std::optional<configure::ControlDesign>& design);

class Engine {
 public:
  /// All must outlive it.
  /// @param has_plant   false: it is elsewhere
  /// @param controller  as it is before its first step; null: it is elsewhere, or there is none
  /// @param result      with the record of that controller, of which the design is filled in
  /// @throws ComputationError
  Engine(const scene::Scene& scene, bool has_plant, ControlPort* controller, const Watch& watch,
         RunResult& result);
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  /// The carrier period that comes next.
  const CarrierClock& clock() const { return clock_; }
  const std::optional<PlantRun>& plant() const { return plant_; }
  std::optional<ControlRun>& control() { return control_; }
  const std::optional<ControlRun>& control() const { return control_; }

  /// Of that period, where the scene's carrier changes.
  void set_frequency_Hz(double frequency_Hz) { clock_.set_frequency_Hz(frequency_Hz); }

  /// On a load from here on, beside that of the scene.
  void set_load_force_N(double force_N) { plant_->set_load_force_N(force_N); }

  /// That period, but for what the plant does in it.
  PlantPeriod begun(double amplitude_N) const;

  /// Moves the plant through it.
  /// @param bias_N  see PlantRun::advance
  /// @throws ComputationError
  PlantPeriod move(double amplitude_N, double bias_N = 0.0);

  /// Shows what has passed, lets the controller take its step, unless the period was cut short, and
  /// goes on to the next.
  /// @param period  what drove it is filled in
  void conclude(PlantPeriod& period);

  /// Fills in what a run ends with.
  void finish();

  void copy_state(StateCopy& copy);

 private:
  void pass_distance(PlantPeriod& period);
  double natural_Hz(double time_s) const;

  const scene::Scene& scene_;
  const Watch& watch_;
  CarrierClock clock_;
  std::optional<PlantRun> plant_;
  std::optional<ControlRun> control_;
  double friction_N_;
  double distance_m_ = 0.0;     ///< that the sliding has gone
  double constant_natural_Hz_;  ///< of a spring that does not change
};

}  // namespace sonoglide::loop
