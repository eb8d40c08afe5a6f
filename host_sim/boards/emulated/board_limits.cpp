#include "host_sim/boards/emulated/board_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "host_sim/configure/configuration_error.hpp"

namespace sonoglide::emulated {

void require_arithmetic(const scene::Scene& scene, const ImageBoard& board) {
  if (!scene.controller) {
    return;
  }
  const scene::Arithmetic arithmetic = scene.controller->arithmetic;
  const bool is_double = arithmetic == scene::Arithmetic::float64;
  if ((is_double || arithmetic == scene::Arithmetic::float32) && !board.computes_single) {
    throw configure::ConfigurationError(
        "controller.arithmetic",
        fmt::format("the {} has no time for floating point; allowed: \"q31\", \"q15\"",
                    board.name));
  }
  if (!is_double || board.computes_double) {
    return;
  }
  std::string capable;
  for (const EmulatedBoard& each : emulated_boards()) {
    if (each.computes_double) {
      capable += fmt::format("{}{}", capable.empty() ? "" : ", ", each.name);
    }
  }
  throw configure::ConfigurationError(
      "controller.arithmetic",
      fmt::format(
          "float64 has no hardware on {} ({}); allowed: \"float32\", \"q31\", \"q15\", or a "
          "board that has it: {}",
          board.name, board.core, capable));
}

void require_carrier_board(const scene::Scene& scene, const EmulatedBoard& board) {
  const auto& boards = carrier_boards();
  if (!scene.controller || std::none_of(boards.begin(), boards.end(), [&](const auto& each) {
        return each.name == board.name;
      })) {
    return;
  }
  const scene::Controller& controller = *scene.controller;
  const scene::Sensor& sensor = scene.sensor;
  const auto require = [&](bool allowed, const char* key, const char* finding) {
    if (!allowed) {
      throw configure::ConfigurationError(key, fmt::format("the {} {}", board.name, finding));
    }
  };
  require(!controller.vibration, "controller.vibration",
          "has no time to observe the vibration; remove it");
  require(controller.every_periods == 1, "controller.every_periods",
          "steps in each carrier period; allowed: 1");
  require(scene.drive->delay_periods == 1, "drive.delay_periods",
          "answers in the carrier period after the sampled one; allowed: 1");
  require(scene.drive->interpolation == scene::Interpolation::step, "drive.interpolation",
          "holds the amplitude over a carrier period; allowed: \"step\"");
  constexpr int bits = 12;
  require(sensor.adc_bits && *sensor.adc_bits <= bits, "sensor.adc_bits",
          "has converters of 12 bits; allowed: 12, or less");
  require(sensor.velocity_bits && *sensor.velocity_bits <= bits, "sensor.velocity_bits",
          "has converters of 12 bits; allowed: 12, or less");
  const int samples = sensor.samples_per_period.value_or(1);
  require(samples == 1 || samples == 2 || samples == 4, "sensor.samples_per_period",
          "converts the force four times in a carrier period; allowed: 1, 2, 4, or remove it");
}

}  // namespace sonoglide::emulated
