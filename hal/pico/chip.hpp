/// The chip of the board, RP2040 or RP2350: where it differs from the other one.
#pragma once

#include SONOGLIDE_CHIP_HEADER
