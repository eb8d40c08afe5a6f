/// What a sketch includes. The Arduino IDE looks for a library by a header at the top of its folder src, and
/// then finds the headers of the core from there.
#pragma once

#undef abs  // Arduino's macro; the name is a function of the core

#include "firmware/app/control_loop.hpp"
#include "firmware/app/target_schedule.hpp"
#include "firmware/control/controller.hpp"
