/// What a plant advances over at once, and the drive in it.
#pragma once

#include "host_sim/loop/plant/step_meter.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

/// A stretch of time with one drive amplitude and a linear sliding velocity that keeps its sign.
struct Stretch {
  double duration_s = 0.0;
  double drive_phase_rad = 0.0;       ///< at its beginning, in [0, 2π)
  double drive_rate_rad_per_s = 0.0;  ///< 2π f; 0 without a drive
  double drive_amplitude_N = 0.0;
  double sliding_velocity_m_per_s = 0.0;  ///< at its beginning
  double sliding_acceleration_m_per_s2 = 0.0;
  /// The stretch lies within one straight piece of it.
  scene::Waveform drive_waveform = scene::Waveform::cosine;
  double begin_s = 0.0;        ///< since the run began: what changes in time is looked up by it
  bool demodulated = false;    ///< the account is to have velocity_in_phase_m and its quadrature
  bool energies = true;        ///< false: what depends on them is left open
  StepMeter* meter = nullptr;  ///< counts the steps
};

/// As plant::CosineDrive, RampDrive or LevelDrive, whichever is the waveform's, takes it.
struct DrivePiece {
  double amplitude_N;
  double phase_rad;  ///< at the beginning of the stretch
};

DrivePiece drive_piece(const Stretch& stretch);

/// Force of the drive at a time since the beginning of the stretch.
double drive_force_N(const Stretch& stretch, double offset_s);

}  // namespace sonoglide::loop
