/// Many independent plants at once, one in each SIMD lane.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "firmware/plant/state.hpp"

namespace sonoglide::batch {

/// y'' = a cos(tau) - d y' - k y - beta phi,  phi' = kappa (V - |V| phi),  V = r + sigma y'.
struct DahlPlant {
  double drive_amplitude = 1.0;    ///< a
  double damping = 0.0;            ///< d >= 0
  double stiffness = 0.0;          ///< k >= 0
  double friction_force = 0.0;     ///< beta >= 0
  double contact_stiffness = 1.0;  ///< kappa in [1e-9, 1e9]
  double sliding_velocity = 0.0;   ///< r, any sign, constant
  double vibration_sign = 1.0;     ///< sigma: +1 dissipative, -1 as the paper prints it
  plant::State<double> initial;    ///< at tau = 0; |phi| <= 1
};

/// The whole run begins at tau = 0, its window at a later period; both end together.
struct RunLength {
  std::uint32_t periods = 100;             ///< whole carrier periods, > 0
  std::uint32_t window_start_periods = 0;  ///< < periods
};

/// Every status but `solved` asks for the scalar solver: the lanes gave that point up.
enum class RunStatus {
  solved,
  outside_range,       ///< a parameter that the lanes are not made for, or no number at all
  undecided_reversal,  ///< V = 0 and its derivative too: higher ones decide where it goes
  too_many_steps,      ///< more than 1024 steps for each period
  not_finite,          ///< the motion has left the range of the scalar
};

struct FrictionAverages {
  double friction_ratio = 0.0;  ///< mean of phi
  double friction_work = 0.0;   ///< integral of phi V over tau
};

struct DahlRun {
  RunStatus status = RunStatus::outside_range;
  FrictionAverages whole;
  FrictionAverages window;
  plant::State<double> final_state;
};

/// What the friction ratio is to be good for: its relative error in a sweep of Table 1 from rest,
/// 100 periods, velocity ratio 0.05 to 1.2. Where the natural frequency exceeds the drive's, or in
/// very stiff contacts, the error may be ten times as large; in mean phi itself, so it matters
/// where that is close to 0.
enum class Accuracy {
  map,   ///< 1e-4: float32 lanes
  fine,  ///< 1e-8: float64 lanes
};

/// What decides the last bit of a lane, by name: the same on every machine.
inline constexpr const char* arithmetic = "lanes with fused multiply-add";

/// The instruction set of this machine that the lanes use: it decides the time.
std::string instruction_set();

/// Runs `count` plants by the event-located Taylor method; runs[i] is that of plants[i].
///
/// Steps end at the reversals of V, and none is passed over. Between them friction follows the
/// displacement exactly: |phi| <= 1 always, and the friction work is exact for the path taken.
/// A point's result is the same, bit for bit, whatever its lane, its neighbours and the way a
/// caller divides the points among threads, and on every instruction set: one without a fused
/// multiply-add takes many times as long instead. A point that the lanes give up says so in its
/// status, in time, and disturbs no other: let plant::EventTaylor solve it.
void run_dahl_plants(const DahlPlant* plants, std::size_t count, const RunLength& length,
                     Accuracy accuracy, DahlRun* runs);

std::vector<DahlRun> run_dahl_plants(const std::vector<DahlPlant>& plants, const RunLength& length,
                                     Accuracy accuracy);

// Many independent plants at once, one in each SIMD lane, whose drive is set anew in each period.

/// Over a carrier period: a = at_zero + slope tau, tau the phase.
struct DriveAmplitude {
  double at_zero = 0.0;
  double slope = 0.0;
};

/// What drives the plants: asked about each of them at the end of each of its carrier periods.
class DriveSource {
 public:
  virtual ~DriveSource() = default;

  /// A carrier period of a plant is over.
  /// @param mean_friction  of phi over that period
  /// @return the drive amplitude a of the next one; absent where the run ends here
  virtual std::optional<DriveAmplitude> next_amplitude(std::size_t plant, double mean_friction) = 0;

  /// Whether an amplitude may have a slope; without it the lanes are a little faster.
  virtual bool ramps() const { return false; }
};

/// Runs `count` plants as run_dahl_plants does, in float64 lanes, from one phase 0 of the drive to
/// the next; statuses[i] is that of plants[i], and `solved` where the source has ended the run.
///
/// The first period has the plant's own drive amplitude. The source hears of the periods of a plant
/// in their order, those of others between them; no more plants than there are lanes run at a time.
/// Error of the mean friction of a period: 1e-6.
void run_driven_plants(const DahlPlant* plants, std::size_t count, DriveSource& source,
                       RunStatus* statuses);

std::vector<RunStatus> run_driven_plants(const std::vector<DahlPlant>& plants, DriveSource& source);

}  // namespace sonoglide::batch
