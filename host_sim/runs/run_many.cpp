#include "host_sim/runs/run_many.hpp"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_for_each.h>
#include <tbb/partitioner.h>

#include <atomic>

namespace sonoglide::runs {

std::size_t thread_count() {
  return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
}

void run_many(const Calls& calls, const std::function<Places(const Places& places)>& together,
              const std::function<void(std::size_t place)>& alone) {
  const std::size_t in_lanes = calls.together.size();
  // One call to a task: those that take long leave the rest to others.
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, in_lanes + calls.alone.size(), 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          if (i < in_lanes) {
            tbb::parallel_for_each(together(calls.together[i]), alone);
          } else {
            alone(calls.alone[i - in_lanes]);
          }
        }
      },
      tbb::simple_partitioner());
}

std::size_t visit_all(std::size_t first, std::size_t end, std::size_t some,
                      const std::function<bool(std::size_t)>& visit,
                      const std::function<void(std::size_t)>& done) {
  std::atomic<std::size_t> lowest{end};
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(first, end, some),
      [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i < std::min(range.end(), lowest.load()); ++i) {
          std::size_t seen = lowest.load();
          if (!visit(i)) {
            while (i < seen && !lowest.compare_exchange_weak(seen, i)) {
            }
          }
        }
        done(range.size());
      },
      tbb::simple_partitioner());
  return lowest;
}

}  // namespace sonoglide::runs
