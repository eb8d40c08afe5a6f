/// How many threads the program works on.
#pragma once

#include <tbb/global_control.h>

namespace sonoglide::process {

/// That anybody may ask for.
inline constexpr unsigned most_threads = 1024;

/// While it lives, work is done on at most so many threads; 0: one for each core.
class ThreadLimit {
 public:
  explicit ThreadLimit(unsigned threads);

 private:
  tbb::global_control limit_;
};

}  // namespace sonoglide::process
