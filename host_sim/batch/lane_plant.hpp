/// What a lane needs of a plant, and what it has to show of it.
#pragma once

#include <cstddef>
#include <limits>

#include "firmware/plant/state.hpp"
#include "host_sim/batch/run_dahl_plants.hpp"

namespace sonoglide::batch {

/// Beyond this displacement or velocity a motion counts as lost.
inline constexpr double farthest = 1e15;

inline constexpr double most_steps_per_period = 1024.0;

/// As many lanes as the widest instruction set has.
inline constexpr std::size_t most_lanes = 64;

/// A plant with what its lane needs besides.
struct LanePlant {
  DahlPlant plant;
  double natural_frequency = 0.0;  ///< sqrt(k)
  double own_rate = 0.5;           ///< the fastest that the plant moves by itself; at least 1/2
};

/// Slides on for ever at phi = 1, with nothing to resolve.
inline constexpr LanePlant idling = {
    {0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, {0.0, 0.0, 1.0}}, 0.0, 0.5};

/// Whole carrier periods from a phase 0 on, under one drive amplitude.
struct LaneStretch {
  double periods = 0.0;
  double drive_amplitude = 0.0;
};

/// Of a lane that idles: nobody is to look at it.
inline constexpr LaneStretch endless = {std::numeric_limits<double>::infinity(), 0.0};

/// What a lane has to show when it stops.
struct Progress {
  plant::State<double> state;
  FrictionAverages integrals;  ///< of phi and of phi V since the stretch began
  double periods_left = 0.0;   ///< of the stretch
};

/// Every parameter is one that the lanes are made for.
bool suits_lanes(const DahlPlant& plant);

LanePlant prepare(const DahlPlant& plant);

/// `solved` where the lane has come to the end of its stretch.
RunStatus status_of(const Progress& progress);

}  // namespace sonoglide::batch
