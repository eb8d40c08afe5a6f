#include "host_sim/cli/design_notes.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <string>

namespace sonoglide::cli {

void print_design_notes(const std::optional<configure::ControlDesign>& design) {
  if (!design) {
    return;
  }
  for (const std::string& note : configure::design_notes(*design)) {
    fmt::print(stderr, "note: {}\n", note);
  }
}

}  // namespace sonoglide::cli
