/// Who watches a run, and what of it: carrier periods, states at chosen times, progress.
#pragma once

#include <complex>
#include <functional>
#include <limits>
#include <vector>

#include "firmware/control/interface/drive_command.hpp"
#include "host_sim/loop/plant/plant_port.hpp"

namespace sonoglide::loop {

/// One carrier period (where there is no drive: one thousandth of the run).
struct Period {
  static constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

  double begin_s = 0.0;
  double end_s = 0.0;
  /// ρ, see PowerRatios; NaN without friction, and of a carrier period that is cut short.
  double friction_ratio = undefined;
  double friction_force_N = undefined;  ///< its mean along the sliding; NaN where ρ is
  double begin_velocity_m_per_s = 0.0;  ///< sliding
  double end_velocity_m_per_s = 0.0;
  double begin_distance_m = 0.0;  ///< that the sliding has gone, backwards negative
  double end_distance_m = 0.0;
  double drive_amplitude_N = 0.0;  ///< in force during it, at its end where it passes linearly
  double frequency_Hz = 0.0;       ///< likewise, of the carrier; 0 without a drive
  double bias_N = 0.0;             ///< likewise: the force that is constant over it
  bool whole = true;               ///< not cut short by the end of the run
  /// z [m/s]: the vibration velocity is Re(z e^jθ), θ the phase of the drive; NaN where
  /// nobody asks for it, and of a period that is cut short.
  std::complex<double> vibration_m_per_s = undefined;
  /// Of the fundamental of a transducer's current, i = Re(current_A e^jθ); NaN without one, and of a
  /// period that is cut short.
  std::complex<double> current_A = undefined;
  /// Part of it in which a contact that vibrates normally is open.
  double open_fraction = 0.0;
  double natural_Hz = 0.0;  ///< of the plant without its damping, in the middle of the period
  /// Velocity that the controller means to hold; NaN where it holds none.
  double wanted_vibration_m_per_s = undefined;
  double target =
      undefined;  ///< that its drive was picked for: ρ, or a force [N]; NaN in open loop
  double target_ratio = undefined;                          ///< ρ that it means to the controller
  control::State state = control::State::off;               ///< of the command in force during it
  control::Limit limit = control::Limit::none;              ///< likewise
  control::Settling settling = control::Settling::pending;  ///< likewise
  double commanded_ratio = undefined;  ///< likewise: friction ratio, target and feedback together
};

/// Takes the carrier periods of a run, in order, as soon as each is over.
class PeriodSink {
 public:
  virtual ~PeriodSink() = default;
  virtual void take(const Period& period) = 0;
};

struct PlantSample {
  double time_s = 0.0;
  PlantState state;
  double drive_force_N = 0.0;
  double sliding_velocity_m_per_s = 0.0;
  double load_displacement_m = 0.0;  ///< 0 without a load
};

/// Takes samples in the order of time.
class SampleSink {
 public:
  virtual ~SampleSink() = default;
  virtual void take(const PlantSample& sample) = 0;
};

/// Equally spaced times: begin_s + i·interval_s up to end_s, ends included.
struct SampleGrid {
  double begin_s;
  double end_s;
  double interval_s;
};

/// Keeps every sample that it is given, column by column.
struct Recording final : SampleSink {
  std::vector<double> time_s;
  std::vector<PlantState> state;
  std::vector<double> drive_force_N;
  std::vector<double> sliding_velocity_m_per_s;
  std::vector<double> load_displacement_m;

  void take(const PlantSample& sample) override {
    time_s.push_back(sample.time_s);
    state.push_back(sample.state);
    drive_force_N.push_back(sample.drive_force_N);
    sliding_velocity_m_per_s.push_back(sample.sliding_velocity_m_per_s);
    load_displacement_m.push_back(sample.load_displacement_m);
  }
};

/// Keeps every carrier period that it is given.
struct PeriodRecording final : PeriodSink {
  std::vector<Period> periods;

  void take(const Period& period) override { periods.push_back(period); }
};

/// Called now and then with the fraction done, in [0, 1].
using Progress = std::function<void(double fraction)>;

/// A sink and the times that it wants to see.
struct Sampling {
  SampleGrid grid;
  SampleSink* sink;
};

/// Watching never changes a bit of the motion, and what nobody watches costs nothing. Sinks outlive
/// the run; what one of them throws ends it.
struct Watch {
  std::vector<PeriodSink*> periods;
  std::vector<Sampling> samples;
  Progress progress;
  /// Energies of the result; false: they are left open, and whoever asks for the friction ratio alone
  /// gets it the sooner.
  bool energies = true;
};

}  // namespace sonoglide::loop
