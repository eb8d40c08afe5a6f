/// What a run's report shows beside the result: gathered while the run goes, in bounded memory.
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "firmware/control/interface/drive_command.hpp"
#include "host_sim/configure/experiment.hpp"
#include "host_sim/loop/plant/carrier_grid.hpp"
#include "host_sim/loop/watch.hpp"
#include "host_sim/report/extremes_curve.hpp"
#include "host_sim/report/step_metrics.hpp"
#include "host_sim/report/texture_metrics.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::report {

/// The course of a run, carrier period by carrier period, for charts.
class Course final : public loop::PeriodSink {
 public:
  enum Ordinate {
    friction_ratio,
    friction_force_N,
    target,
    drive_amplitude_N,
    sliding_velocity_m_per_s,
    bias_N,
    load_displacement_m,
    ordinates
  };
  using Curve = report::ExtremesCurve<ordinates>;

  void take(const loop::Period& period) override;

  const Curve& curve() const { return curve_; }
  /// Carrier periods that a limit was in force in; of contact_lost those in which the contact opens.
  std::uint64_t periods_in(control::Limit limit) const {
    return periods_in_[static_cast<std::size_t>(limit)];
  }

  /// Magnitude.
  double largest_bias_N() const { return largest_bias_N_; }
  /// Of the sliding, where carrier periods begin and end.
  double fastest_m_per_s() const { return fastest_m_per_s_; }
  /// From the least to the largest displacement of the sliding, likewise.
  double travel_m() const { return farthest_m_ - nearest_m_; }

 private:
  static constexpr std::size_t most_points = 20000;

  Curve curve_{most_points};
  double largest_bias_N_ = 0.0;
  double fastest_m_per_s_ = 0.0;
  double nearest_m_ = 0.0;
  double farthest_m_ = 0.0;
  std::array<std::uint64_t, control::limit_count> periods_in_{};
};

/// The fundamental of vibration and, with a transducer, of the current, carrier period by carrier
/// period.
class VibrationCourse final : public loop::PeriodSink {
 public:
  /// The phase is that of the vibration velocity ahead of the carrier, in degrees. A drive below 0
  /// does not turn it.
  enum Ordinate {
    vibration_m_per_s,
    wanted_m_per_s,
    current_A,
    frequency_Hz,
    natural_Hz,
    phase_deg,
    ordinates
  };
  using Curve = report::ExtremesCurve<ordinates>;

  explicit VibrationCourse(const std::optional<scene::Transducer>& transducer)
      : transducer_(transducer) {}

  void take(const loop::Period& period) override;

  const Curve& curve() const { return curve_; }

  /// Mean of about the last `operating_periods` whole periods with a voltage: noise leaves it.
  struct OperatingPoint {
    double frequency_Hz;
    std::complex<double> admittance_S;
  };
  static constexpr double operating_periods = 64.0;
  /// None where the voltage was mostly to change the vibration.
  std::optional<OperatingPoint> operating_point() const;

 private:
  static constexpr std::size_t most_points = 20000;

  void remember(const loop::Period& period);

  std::optional<scene::Transducer> transducer_;
  Curve curve_{most_points};
  /// Sums that forget.
  struct {
    double periods = 0.0;
    double frequency_Hz = 0.0;
    double voltage_V = 0.0;
    double either_voltage_V = 0.0;
    std::complex<double> current_A;
  } recent_;
};

class RunFindings {
 public:
  /// @param experiment  outlives this
  explicit RunFindings(const configure::Experiment& experiment);
  RunFindings(const RunFindings&) = delete;
  RunFindings& operator=(const RunFindings&) = delete;

  /// Asks for what is to be gathered. This outlives the run.
  void join(loop::Watch& watch);

  /// In open loop empty.
  std::vector<report::StepMetrics> steps() const;
  /// Of a loop that learns the friction force anew.
  report::PauseMetrics pauses() const;
  std::optional<double> largest_tracking_error() const;
  /// In open loop, and without a calibration, an empty range.
  CalibrationMetrics calibration() const {
    return step_meter_ ? step_meter_->calibration() : CalibrationMetrics();
  }
  const Course& course() const { return course_; }
  /// Null without a texture.
  const TextureMeter* texture() const { return texture_meter_ ? &*texture_meter_ : nullptr; }
  /// Null without a transducer.
  const VibrationCourse* vibration() const { return vibration_ ? &*vibration_ : nullptr; }
  /// A few carrier periods at each of the first target steps; in open loop at the beginning.
  const std::vector<loop::Recording>& close_ups() const { return close_ups_; }
  /// The last carrier periods, for loops and spectra.
  const loop::Recording& ending() const { return ending_; }

 private:
  std::vector<double> target_steps_s() const;
  loop::SampleGrid close_up_grid(double step_s) const;
  loop::SampleGrid ending_grid(double last_step_s) const;

  const scene::Scene& scene_;
  loop::CarrierGrid grid_;
  std::optional<report::StepMeter> step_meter_;
  std::optional<report::TrackingMeter> tracking_meter_;
  std::optional<TextureMeter> texture_meter_;
  Course course_;
  std::optional<VibrationCourse> vibration_;
  std::vector<loop::Recording> close_ups_;
  loop::Recording ending_;
};

}  // namespace sonoglide::report
