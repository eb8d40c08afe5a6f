/// Independent pieces of work on every core.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include <cstddef>
#include <functional>
#include <mutex>

namespace sonoglide::stability {

/// Told the part that is done, from 0 to 1; never from two threads at once.
using Progress = std::function<void(double)>;

/// Calls work(i) once for each i below count, `batch` of them between two reports of progress.
template <class Work>
void for_each_index(std::size_t count, std::size_t batch, const Progress& progress,
                    const Work& work) {
  std::mutex mutex;
  std::size_t done = 0;
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, count, batch),
      [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          work(i);
        }
        const std::lock_guard<std::mutex> lock(mutex);
        done += range.size();
        progress(static_cast<double>(done) / static_cast<double>(count));
      },
      tbb::simple_partitioner());
}

}  // namespace sonoglide::stability
