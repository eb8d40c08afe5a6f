#include "host_sim/process/thread_limit.hpp"

#include <tbb/info.h>

#include <cstddef>

namespace sonoglide::process {

ThreadLimit::ThreadLimit(unsigned threads)
    : limit_(tbb::global_control::max_allowed_parallelism,
             threads > 0 ? threads : static_cast<std::size_t>(tbb::info::default_concurrency())) {}

}  // namespace sonoglide::process
