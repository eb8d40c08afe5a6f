/// What an FMU holds of a scene.
#pragma once

#include <cstdint>

#include "host_sim/scene/scene.hpp"
#include "host_sim/stepped/kind.hpp"

namespace sonoglide::fmi {

struct Content {
  stepped::Kind kind;
  bool clock;  ///< event mode, and a clock that ticks once a carrier period
};

/// Carrier frequency as the resolution of the clock, whose interval is 1/resolution.
/// @return  [Hz]
/// @throws configure::ConfigurationError  it is no whole number
std::uint64_t clock_resolution_Hz(const scene::Scene& scene);

}  // namespace sonoglide::fmi
