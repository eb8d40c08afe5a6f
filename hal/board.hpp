/// The seam between the controller and a board: all that a board must offer.
#pragma once

#include <cstdint>

namespace sonoglide::hal {

/// One sample, taken once per carrier period. Codes are left-justified: ±2^31 is ± full scale,
/// whatever the converter's width.
struct Sample {
  std::int32_t friction_force;    ///< mean over the last carrier period; full scale: the sensor's
  std::int32_t sliding_velocity;  ///< full scale: peak vibration velocity at full drive
  bool force_at_rail;             ///< the force converter stood at either end of its range
  bool fresh;                     ///< false where no sample arrived since the last one
};

/// Answer to a sample; the amplitude is applied from the next drive phase 0 on.
struct Drive {
  std::int32_t amplitude;  ///< 0 … 2^31 − 1, full scale: the actuator's limit
  std::uint8_t state;      ///< control::State
  std::uint8_t limit;      ///< control::Limit
  std::uint8_t fault;      ///< control::Fault
};

/// A board is a class of this shape; none derives from it, the app is compiled for one:
///
///   class Board {
///    public:
///     bool sample(Sample& sample);     // waits for the next carrier period; false: shut down
///     void drive(const Drive& drive);  // in force from the next drive phase 0 on
///   };

}  // namespace sonoglide::hal
