/// The sensors of friction force, sliding velocity and vibration between plant and controller.
#pragma once

#include <complex>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "hal/board.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/loop/plant/snapshot.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

/// Turns the true mean friction force of each carrier period into the sample that the board gets:
/// first-order low-pass, delay, gain and offset, noise, converter. The sliding velocity goes
/// through its gain and offset, and a converter of 32 bits.
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

  /// @param mean_force_N  true mean over the carrier period just ended
  hal::Sample sample(double mean_force_N, double sliding_velocity_m_per_s);

  /// The same with the vibration.
  /// @param vibration_m_per_s  z of the period: the vibration velocity is Re(z e^jθ), θ the phase of
  ///                           the drive
  hal::VibrationSample sample(double mean_force_N, double sliding_velocity_m_per_s,
                              std::complex<double> vibration_m_per_s);

  /// The same with the mean velocity of the vibration, which the converter limits to its range.
  hal::MotionSample sample(double mean_force_N, double sliding_velocity_m_per_s,
                           std::complex<double> vibration_m_per_s, double mean_velocity_m_per_s);

  void save(SnapshotWriter& state) const;
  void restore(SnapshotReader& state);

 private:
  struct Conversion {
    std::int32_t code;  ///< left-justified
    bool at_rail;
  };

  /// Of a velocity of the vibration.
  Conversion seen(double velocity_m_per_s);
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
  std::vector<double> pipeline_N_;  ///< a ring
  std::size_t oldest_ = 0;          ///< in it
  std::mt19937_64 generator_;
};

}  // namespace sonoglide::loop
