/// Many independent plants at once, one in each SIMD lane, whose drive is set anew in each period.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "host_sim/batch/run_dahl_plants.hpp"

namespace sonoglide::batch {

/// What drives the plants: asked about each of them at the end of each of its carrier periods.
class DriveSource {
 public:
  virtual ~DriveSource() = default;

  /// A carrier period of a plant is over.
  /// @param mean_friction  of phi over that period
  /// @return the drive amplitude a of the next one; absent where the run ends here
  virtual std::optional<double> next_amplitude(std::size_t plant, double mean_friction) = 0;
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
