#include "host_sim/cli/design_notes.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <string>

#include "host_sim/scene/control_design.hpp"

namespace sonoglide::cli {

void print_design_notes(const scene::Scene& scene) {
  if (!scene.controller) {
    return;
  }
  for (const std::string& note : scene::design_notes(scene::design_control(scene))) {
    fmt::print(stderr, "note: {}\n", note);
  }
}

}  // namespace sonoglide::cli
