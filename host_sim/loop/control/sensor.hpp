/// The sensors of friction force, sliding velocity and vibration between plant and controller.
#pragma once

#include <complex>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "hal/board.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/loop/plant/snapshot.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

/// The true friction force over the carrier period just ended.
struct PeriodForce {
  // NOLINTNEXTLINE(google-explicit-constructor): a mean is a force
  PeriodForce(double mean, std::vector<double> samples = {})
      : mean_N(mean), samples_N(std::move(samples)) {}

  double mean_N;
  /// What a converter sees that samples it, see ForceSampler; none where the mean stands for each.
  std::vector<double> samples_N;
};

/// What a converter gives.
struct Conversion {
  std::int32_t code;  ///< left-justified
  bool at_rail;       ///< it stood at either end of its range
};

/// Turns the true friction force of each carrier period into the sample that the board gets:
/// first-order low-pass, delay, gain and offset, noise, converter; of a force that is sampled, the
/// mean of what the converter reads, to 32 bits. The sliding velocity goes through its gain and offset,
/// and a converter.
///
/// The vibration is seen as its velocity, or as the motional current over the believed force factor:
/// with noise, in converters of its own. Without a force sensor the force reads 0.
///
/// Gain and offset are those of the wiring: before the delay's first reading has arrived, the
/// sensor reads its offset.
///
/// The low-pass acts on the running mean over one carrier period, taken as linear between samples:
/// a sensor that is slow against the carrier and averages over it. Its noise is white and
/// Gaussian, drawn by Box–Muller from a 64-bit Mersenne twister: same seed, same samples, on every
/// machine.
class Sensor {
 public:
  /// @param vibration_gain  vibration read over the true one
  Sensor(const scene::Sensor& sensor, const configure::ControlScales& scales,
         double vibration_gain = 1.0);

  hal::Sample sample(const PeriodForce& force, double sliding_velocity_m_per_s);

  /// A carrier period that nobody looks at.
  void pass(const PeriodForce& force);

  /// The same with the vibration.
  /// @param vibration_m_per_s  z of the period: the vibration velocity is Re(z e^jθ), θ the phase of
  ///                           the drive
  hal::VibrationSample sample(const PeriodForce& force, double sliding_velocity_m_per_s,
                              std::complex<double> vibration_m_per_s);

  /// The same with the mean velocity of the vibration, which the converter limits to its range.
  hal::MotionSample sample(const PeriodForce& force, double sliding_velocity_m_per_s,
                           std::complex<double> vibration_m_per_s, double mean_velocity_m_per_s);

  void copy_state(StateCopy& copy);

 private:
  /// Of a velocity of the vibration.
  Conversion seen(double velocity_m_per_s);
  Conversion converted(double force_N);
  Conversion reading(const PeriodForce& force);
  /// @param take  is called with the force of each conversion, behind the low-pass
  template <class Take>
  void for_each_conversion(const PeriodForce& force, const Take& take);
  double filtered(double force_N);
  double delayed(double force_N);
  double noise(double rms);

  scene::Sensor sensor_;
  configure::ControlScales scales_;
  double vibration_gain_;
  double filter_decay_ = 0.0;       ///< exp(−T/τ)
  double filter_new_weight_ = 1.0;  ///< of the sample that ends the period
  double filter_state_N_ = 0.0;
  double filter_input_N_ = 0.0;
  int conversions_;                 ///< of the force, in a carrier period
  std::vector<double> pipeline_N_;  ///< a ring
  std::size_t oldest_ = 0;          ///< in it
  std::mt19937_64 generator_;
};

}  // namespace sonoglide::loop
