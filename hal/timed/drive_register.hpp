/// The drive of a board that has no modulator.
#pragma once

#include <cstdint>

/// The amplitude in force, a code of 0 ... 2^31 - 1: in place of a modulator's register, and like
/// one at zero from reset on. The board's exception handler clears it (hal/halt).
extern "C" volatile std::int32_t drive_amplitude;
