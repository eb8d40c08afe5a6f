#include "host_sim/cli/run_watch.hpp"

#include <fmt/format.h>

#include "host_sim/loop/step_forecast.hpp"
#include "host_sim/process/printable.hpp"

namespace sonoglide::cli {

void print_notes(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) {
    process::show_on_stderr("note: " + note);
  }
}

void print_design_notes(const std::optional<configure::ControlDesign>& design) {
  if (design) {
    print_notes(configure::design_notes(*design));
  }
}

void announce_long_run(const scene::Scene& scene) {
  constexpr double steps_of_a_minute = 1e8;
  const double steps = loop::expected_steps(scene);
  if (steps >= steps_of_a_minute) {
    process::show_on_stderr(
        fmt::format("note: about {:.2g} steps are expected, which take minutes", steps));
  }
}

loop::Progress watching(ProgressBar& bar) {
  return [&bar](double fraction) { bar.update(fraction); };
}

loop::Watch run_watch(report::RunReport& report, ProgressBar& bar) {
  loop::Watch watch;
  report.join(watch);
  watch.progress = watching(bar);
  return watch;
}

}  // namespace sonoglide::cli
