/// The sensors of friction force and sliding velocity between plant and controller.
#pragma once

#include <cstdint>
#include <deque>
#include <random>

#include "hal/board.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

/// Turns the true mean friction force of each carrier period into the sample that the board gets:
/// first-order low-pass, delay, gain and offset, noise, converter. The sliding velocity goes
/// through its gain and offset, and a converter of 32 bits.
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
  Sensor(const scene::Sensor& sensor, const configure::ControlScales& scales);

  /// @param mean_force_N  true mean over the carrier period just ended
  hal::Sample sample(double mean_force_N, double sliding_velocity_m_per_s);

 private:
  double filtered(double force_N);
  double delayed(double force_N);
  double noise();

  scene::Sensor sensor_;
  configure::ControlScales scales_;
  double filter_decay_ = 0.0;       ///< exp(−T/τ)
  double filter_new_weight_ = 1.0;  ///< of the sample that ends the period
  double filter_state_N_ = 0.0;
  double filter_input_N_ = 0.0;
  std::deque<double> pipeline_N_;
  std::mt19937_64 generator_;
};

}  // namespace sonoglide::loop
