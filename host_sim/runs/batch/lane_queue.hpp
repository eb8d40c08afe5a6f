/// The plants still to be run, and those that lanes are running.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>

#include "firmware/plant/state.hpp"
#include "host_sim/runs/batch/run_dahl_plants.hpp"

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

/// Whole carrier periods from a phase 0 on, under one drive amplitude; one period, where that changes.
struct LaneStretch {
  double periods = 0.0;
  DriveAmplitude drive;
};

/// Of the force within a period, and of its first two derivatives.
double bound_of(const DriveAmplitude& drive);

/// Of a lane that idles: nobody is to look at it.
inline constexpr LaneStretch endless = {std::numeric_limits<double>::infinity(), {}};

/// What a lane has to show when it stops.
struct Progress {
  plant::State<double> state;
  FrictionAverages integrals;  ///< of phi and of phi V since the stretch began
  double periods_left = 0.0;   ///< of the stretch
};

/// Hands out plants and takes results in, a stretch of a run at a time.
class LaneQueue {
 public:
  LaneQueue(const DahlPlant* plants, std::size_t count) : plants_(plants), count_(count) {}
  virtual ~LaneQueue() = default;
  LaneQueue(const LaneQueue&) = delete;
  LaneQueue& operator=(const LaneQueue&) = delete;

  bool busy() const { return busy_ > 0; }

  /// The next plant that lanes can run, or one at rest that idles in a lane which nobody needs.
  LanePlant next(std::size_t lane);

  /// The same, after the lane could not decide a reversal of its plant.
  LanePlant give_up(std::size_t lane);

  /// Takes the lane's stretch in. False where the run has ended, well or not.
  bool goes_on(std::size_t lane, const Progress& progress);

  /// What the lane does until it stops again.
  const LaneStretch& stretch(std::size_t lane) const { return lanes_[lane].stretch; }

 protected:
  const DahlPlant& plant(std::size_t point) const { return plants_[point]; }

 private:
  struct Lane {
    bool idle = true;
    std::size_t point = 0;
    LaneStretch stretch = endless;
  };

  virtual void set_status(std::size_t point, RunStatus status) = 0;
  virtual LaneStretch first_stretch(std::size_t lane, std::size_t point) = 0;
  /// Takes a stretch of a plant in, which has come to its end.
  /// @return absent where the run ends here
  virtual std::optional<LaneStretch> next_stretch(std::size_t lane, std::size_t point,
                                                  const Progress& progress) = 0;
  void end(Lane& lane, RunStatus status);

  const DahlPlant* plants_;
  std::size_t count_;
  std::size_t next_point_ = 0;
  std::size_t busy_ = 0;
  std::array<Lane, most_lanes> lanes_;
};

}  // namespace sonoglide::batch
