#include "host_sim/cli/run_watch.hpp"

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
