/// The drive of a board that has no modulator.
#pragma once

#include <cstdint>

/// The amplitude in force, a code of 0 ... 2^31 - 1. It stands for the register of a modulator and,
/// like one, is zero from reset on. The board's exception handler clears it (hal/halt).
extern "C" volatile std::int32_t drive_amplitude;
