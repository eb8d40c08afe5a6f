#include "host_sim/cli/run_watch.hpp"

namespace sonoglide::cli {

loop::Watch run_watch(report::RunReport& report, ProgressBar& bar,
                      const Interruption& interruption) {
  loop::Watch watch;
  report.join(watch);
  watch.progress = [&](double fraction) {
    interruption.check();
    bar.update(fraction);
  };
  return watch;
}

}  // namespace sonoglide::cli
