/// How many threads the program works on.
#pragma once

#include <tbb/global_control.h>
#include <tbb/info.h>

#include <cstddef>

namespace sonoglide::process {

/// That anybody may ask for.
inline constexpr unsigned most_threads = 1024;

/// While it lives, work is done on at most so many threads; 0: one for each core.
class ThreadLimit {
 public:
  explicit ThreadLimit(unsigned threads)
      : limit_(tbb::global_control::max_allowed_parallelism,
               threads > 0 ? threads : static_cast<std::size_t>(tbb::info::default_concurrency())) {
  }

 private:
  tbb::global_control limit_;
};

}  // namespace sonoglide::process
