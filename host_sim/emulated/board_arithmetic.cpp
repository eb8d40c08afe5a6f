#include "host_sim/emulated/board_arithmetic.hpp"

#include <fmt/format.h>

#include <string>

#include "host_sim/configure/configuration_error.hpp"

namespace sonoglide::emulated {

void require_arithmetic(const scene::Scene& scene, const emulated::EmulatedBoard& board) {
  const bool wanted =
      scene.controller && scene.controller->arithmetic == scene::Arithmetic::float64;
  if (!wanted || board.computes_double) {
    return;
  }
  std::string capable;
  for (const emulated::EmulatedBoard& each : emulated::emulated_boards()) {
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

}  // namespace sonoglide::emulated
