#include "host_sim/cli/run_watch.hpp"

#include <string>

#include "host_sim/process/printable.hpp"

namespace sonoglide::cli {

void print_design_notes(const std::optional<configure::ControlDesign>& design) {
  if (!design) {
    return;
  }
  for (const std::string& note : configure::design_notes(*design)) {
    process::show_on_stderr("note: " + note);
  }
}

loop::Progress watching(ProgressBar& bar, const process::Interruption& interruption) {
  return [&bar, &interruption](double fraction) {
    interruption.check();
    bar.update(fraction);
  };
}

loop::Watch run_watch(report::RunReport& report, ProgressBar& bar,
                      const process::Interruption& interruption) {
  loop::Watch watch;
  report.join(watch);
  watch.progress = watching(bar, interruption);
  return watch;
}

}  // namespace sonoglide::cli
