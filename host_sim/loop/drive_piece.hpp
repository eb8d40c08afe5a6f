/// The part of a drive's waveform that a stretch of time lies in.
#pragma once

#include "host_sim/loop/plant_port.hpp"

namespace sonoglide::loop {

/// As plant::CosineDrive, RampDrive or LevelDrive, whichever is the waveform's, takes it.
struct DrivePiece {
  double amplitude_N;
  double phase_rad;  ///< at the beginning of the stretch
};

DrivePiece drive_piece(const Stretch& stretch);

/// Force of the drive at a time since the beginning of the stretch.
double drive_force_N(const Stretch& stretch, double offset_s);

}  // namespace sonoglide::loop
