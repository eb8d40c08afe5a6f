/// A board that is the plant itself, in integers.
#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware/image/plant/signal_path.hpp"
#include "firmware/numeric/fixed.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/plant/strang/fixed_point_strang.hpp"
#include "hal/board.hpp"

namespace sonoglide::image {

/// As PlantBoard, for a processor without a floating-point unit.
template <std::size_t LatencyPeriods>
class FixedPlantBoard {
 public:
  struct Parameters {
    plant::FixedStrangParameters plant;
    std::int32_t force_per_friction;  ///< Fc / force full scale, below 1, 26 fraction bits
    std::int32_t sliding_code;        ///< constant, as a sample has it
  };

  explicit FixedPlantBoard(const Parameters& parameters)
      : plant_(parameters.plant),
        force_per_friction_(parameters.force_per_friction),
        sliding_code_(parameters.sliding_code) {}

  /// False from the period on in which the motion has left the range of the integers.
  bool sample(hal::Sample& sample) {
    constexpr int fraction_bits = 31;  // of 2^(6 + 30 + 26), 2^31 are in the code
    const std::int64_t force = numeric::shift_right_rounded(
        plant_.advance(amplitude_.in_force()) * force_per_friction_, fraction_bits);
    const std::int64_t code = numeric::clamp<std::int64_t>(force, INT32_MIN, INT32_MAX);
    sample = {static_cast<std::int32_t>(code), sliding_code_, code != force, true,
              at_rail(sliding_code_)};
    return plant_.saturations() == 0;
  }

  void drive(const hal::Drive& drive) { amplitude_.take(drive.amplitude); }

 private:
  plant::FixedStrang plant_;
  std::int32_t force_per_friction_;
  std::int32_t sliding_code_;
  DriveLatency<std::int32_t, LatencyPeriods> amplitude_;
};

}  // namespace sonoglide::image
