#include "host_sim/emulated/one_core.hpp"

namespace sonoglide::emulated {

OneCore::OneCore() {
  const int core = sched_getcpu();
  if (core < 0 || core >= CPU_SETSIZE || sched_getaffinity(0, sizeof previous_, &previous_) != 0) {
    return;
  }
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(static_cast<unsigned>(core), &one);
  changed_ = sched_setaffinity(0, sizeof one, &one) == 0;
}

OneCore::~OneCore() {
  if (changed_) {
    sched_setaffinity(0, sizeof previous_, &previous_);
  }
}

}  // namespace sonoglide::emulated
