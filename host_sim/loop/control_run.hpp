/// The controller's side of a closed loop: what drives the next carrier period, and the account of
/// it.
#pragma once

#include <complex>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "firmware/app/timed_targets.hpp"
#include "firmware/control/interface/drive_command.hpp"
#include "hal/trace_hash.hpp"
#include "host_sim/loop/control/actuator.hpp"
#include "host_sim/loop/control/control_port.hpp"
#include "host_sim/loop/control/sensor.hpp"
#include "host_sim/loop/plant/carrier_grid.hpp"
#include "host_sim/loop/run_result.hpp"
#include "host_sim/loop/watch.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

/// A target step on the grid of the samples.
struct ScheduledTarget {
  /// In force from this step of the controller on, counted from 0; of a resonant loop from the
  /// first sample at this time or after, as app::ElapsedPeriods counts it.
  std::uint64_t place;
  double time_s;  ///< as the scene has it
  double target;  ///< likewise
};

/// The target steps of a closed loop, for a controller in this process and for an image alike.
std::vector<ScheduledTarget> target_schedule(const scene::Scene& scene, const CarrierGrid& grid);

class ControlRun {
 public:
  /// @param record  its design is used, the rest filled in; all must outlive this
  ControlRun(const scene::Scene& scene, const CarrierGrid& grid, ControlPort& port,
             ControlRecord& record);

  /// In force during the next carrier period.
  double amplitude_N() const { return actuator_.in_force().amplitude_N; }
  double bias_N() const { return actuator_.in_force().bias_N; }
  double frequency_Hz() const;
  /// The answers set a bias, too.
  bool answers_with_bias() const { return record_.design.bias.has_value(); }
  /// The answers set the frequency of the drive.
  bool leads_frequency() const { return elapsed_.has_value(); }

  /// Notes in the period that has just passed what drove it.
  void label(Period& period) const;

  /// The end of a carrier period; a control step, if it is the last of controller.every_periods.
  /// @param vibration_m_per_s      of the period, see Sensor; of use to a loop that observes it
  /// @param mean_velocity_m_per_s  likewise, of the vibration; of use to one that answers with a bias
  void step(double time_s, const PeriodForce& force, double sliding_velocity_m_per_s,
            std::complex<double> vibration_m_per_s = {}, double mean_velocity_m_per_s = 0.0);

  /// Of the sample that comes next and of those after it, in place of the scene's steps.
  /// @param target  a friction ratio in (0, 1], or a force [N]
  void aim_at(double target);

  /// The controller's last one; all 0 before the first.
  const hal::Drive& answer() const { return answer_; }
  /// Of the answers so far.
  std::uint64_t trace_hash() const { return hash_.value(); }

  /// Of all that the loop goes on from, with the counts of the record but for its faults.
  void copy_state(StateCopy& copy);

  /// Fills in what the run ends with.
  void finish();

 private:
  void follow_target();
  void learn(double mean_force_N);
  template <class Drive>
  void take(const Drive& drive, double time_s);
  template <class Drive>
  void account_for(const Drive& drive, double time_s);

  std::vector<ScheduledTarget> schedule_;
  std::optional<scene::Texture> texture_;
  bool follows_texture_;  ///< until another target is set
  ControlPort& port_;
  ControlRecord& record_;
  bool observes_vibration_;
  Sensor sensor_;
  Actuator actuator_;
  hal::TraceHash hash_;
  hal::Drive answer_{};
  std::size_t next_step_ = 0;
  int every_periods_;
  int periods_ = 0;         ///< since the last step
  std::uint64_t step_ = 0;  ///< that comes next
  double start_frequency_Hz_;
  double clock_ratio_;                          ///< true frequency of the drive over the commanded
  double nominal_friction_N_;                   ///< as the controller learns it, but for noise
  std::optional<app::ElapsedPeriods> elapsed_;  ///< of a resonant loop
  double target_ = std::numeric_limits<double>::quiet_NaN();
  control::Fault fault_ = control::Fault::none;
};

}  // namespace sonoglide::loop
