#include "host_sim/cli/run_watch.hpp"

namespace sonoglide::cli {

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
