#include "host_sim/cli/design_notes.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <string>

#include "host_sim/configure/control_design.hpp"

namespace sonoglide::cli {

void print_design_notes(const scene::Scene& scene) {
  if (!scene.controller) {
    return;
  }
  for (const std::string& note : configure::design_notes(configure::design_control(scene))) {
    fmt::print(stderr, "note: {}\n", note);
  }
}

}  // namespace sonoglide::cli
