/// Two processes that take turns, on one core.
#pragma once

#include <sched.h>

namespace sonoglide::emulated {

/// Keeps the calling thread, and every process that it starts meanwhile, on the core that it is on.
/// In lockstep one side always sleeps until the other has spoken: waking it on the same core takes
/// a quarter of the time. Not for a side that looks again and again instead of sleeping. Where the
/// system does not allow it, nothing changes.
class OneCore {
 public:
  OneCore();
  ~OneCore();
  OneCore(const OneCore&) = delete;
  OneCore& operator=(const OneCore&) = delete;

 private:
  cpu_set_t previous_{};
  bool changed_ = false;
};

}  // namespace sonoglide::emulated
