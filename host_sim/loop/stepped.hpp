/// A scene's plant, its controller or both, stepped from outside by whole carrier periods.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "hal/board.hpp"
#include "host_sim/configure/experiment.hpp"
#include "host_sim/loop/control/control_port.hpp"
#include "host_sim/loop/engine.hpp"
#include "host_sim/loop/plant/snapshot.hpp"
#include "host_sim/scene/names.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

/// What of a closed loop is stepped from outside.
enum class Kind {
  plant,       ///< oscillator and contact
  controller,  ///< sensors, controller, actuator
  loop         ///< both, joined as in `run`
};

inline constexpr std::array kinds = {scene::Named<Kind>{"plant", Kind::plant},
                                     scene::Named<Kind>{"controller", Kind::controller},
                                     scene::Named<Kind>{"loop", Kind::loop}};

constexpr bool has_plant(Kind kind) {
  return kind != Kind::controller;
}
constexpr bool has_controller(Kind kind) {
  return kind != Kind::plant;
}

/// What the plant shows at the end of a carrier period. Before the first period the means are 0.
struct PlantOutputs {
  double mean_friction_force_N = 0.0;     ///< over the period
  double sliding_velocity_m_per_s = 0.0;  ///< at its end
  double vibration_in_phase_m_per_s = 0.0;
  double vibration_quadrature_m_per_s = 0.0;
  double friction_ratio = 0.0;  ///< of the period; 0 where there is no friction to relate it to
  double resistance_N = 0.0;    ///< mean friction along the sliding; 0 likewise
  double displacement_m = 0.0;
  double velocity_m_per_s = 0.0;
  double friction_force_N = 0.0;
  double load_displacement_m = 0.0;  ///< 0 without a load
  double sliding_distance_m = 0.0;   ///< that the sliding has gone, backwards negative
};

/// What the controller answers at the end of a carrier period.
struct ControllerOutputs {
  double drive_force_amplitude_N = 0.0;  ///< in force during the period that comes next
  double drive_frequency_Hz = 0.0;       ///< likewise, of the carrier
  hal::Drive answer{};                   ///< to the sample of the last period
  std::uint64_t trace_hash = 0;          ///< of all answers, as in summary.json
};

/// What holds during a carrier period.
struct Inputs {
  double drive_force_amplitude_N = 0.0;  ///< of a plant without its controller
  double drive_frequency_Hz = 0.0;       ///< likewise, where the scene's carrier changes
  PlantOutputs seen;                     ///< by a controller without its plant
  double target = 0.0;                   ///< friction ratio, or force [N]; 0: the scene's own steps
  double load_force_N = 0.0;             ///< on a load, beside that of the scene
};

/// What of a scene cannot be stepped.
/// @throws configure::ConfigurationError
void require_usable(const scene::Scene& scene, Kind kind);

/// For what counts in carrier periods of one length.
/// @param scene  with a drive
/// @throws configure::ConfigurationError
void require_constant_carrier(const scene::Scene& scene);

/// Carrier periods that no simulation reaches: a clock counts to no more.
inline constexpr double endless_periods = 1e12;

class SteppedScene {
 public:
  /// @param experiment  usable for the kind; its run has no end here
  /// @throws ComputationError
  SteppedScene(const configure::Experiment& experiment, Kind kind);

  /// The carrier period that comes next.
  CarrierClock next_period(const Inputs& inputs) const;
  /// Carries it out: first the plant, then, at its end, the controller.
  /// @throws ComputationError
  void advance(const Inputs& inputs);

  const PlantOutputs& plant() const { return plant_outputs_; }
  const ControllerOutputs& controller() const { return controller_outputs_; }
  /// The controller names another fault than in the period before.
  bool fault_began() const { return fault_began_; }

  /// @param copy  back: of an equal scene and the same kind
  /// @throws std::invalid_argument  it cannot be that
  void copy_state(StateCopy& copy);

 private:
  bool has_plant() const { return engine_.plant().has_value(); }
  void show_plant(const PlantPeriod& period);
  void show_controller();

  scene::Scene scene_;
  bool carrier_changes_;
  Watch watch_;
  RunResult result_;
  std::unique_ptr<ControlPort> port_;
  Engine engine_;
  PlantOutputs plant_outputs_;
  ControllerOutputs controller_outputs_;
  bool fault_began_ = false;
};

}  // namespace sonoglide::loop
