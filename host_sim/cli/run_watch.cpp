#include "host_sim/cli/run_watch.hpp"

#include <fmt/format.h>

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

void announce_long_work(double expected_steps) {
  constexpr double steps_of_a_minute = 1e8;
  if (expected_steps >= steps_of_a_minute) {
    process::show_on_stderr(fmt::format(
        "note: about {:.2g} steps are expected, minutes of work for one core", expected_steps));
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
