/// Where a controller meets the simulation: one exchange per carrier period.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "firmware/numeric/signal_ledger.hpp"
#include "hal/board.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/loop/control/friction_belief.hpp"
#include "host_sim/loop/plant/snapshot.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

/// A controller seen from outside, wherever it runs.
class ControlPort {
 public:
  virtual ~ControlPort() = default;
  /// Sets the target: a friction ratio in (0, 1], or a force [N].
  virtual void set_target(double target) = 0;
  /// One control step. A controller overrides the one of these that it answers.
  virtual hal::Drive exchange(const hal::Sample& sample);
  /// The same of a controller that observes the vibration.
  virtual hal::ResonantDrive exchange(const hal::VibrationSample& sample);
  /// The same of a controller that answers with a bias too.
  virtual hal::BiasedDrive exchange_biased(const hal::Sample& sample);
  virtual hal::BiasedDrive exchange_biased(const hal::MotionSample& sample);
  /// What the fixed-point signals did so far; empty for floating point.
  virtual std::vector<numeric::SignalRecord> signals() const = 0;
  /// Of friction that is learnt while driving; absent of any other, and of an image.
  virtual std::optional<FrictionBelief> friction() const;
  /// Of the state, but for signals(), to go on from in a port that was made for the same design.
  /// @throws std::logic_error  the controller is out of reach
  virtual void copy_state(StateCopy& copy);
};

/// The controller of a scene, in this process: the image's control loop on a simulated board.
std::unique_ptr<ControlPort> make_control_port(const scene::Scene& scene,
                                               const configure::ControlDesign& design);

/// Defined in compose_control.hpp. Each arithmetic has a translation unit of its own, which CMake
/// makes of arithmetic_control.cpp.in: they take long to compile.
template <class Scalar>
std::unique_ptr<ControlPort> make_control(const configure::ControlDesign& design);

}  // namespace sonoglide::loop
