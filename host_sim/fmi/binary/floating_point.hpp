/// The rounding and the handling of small numbers that the computation is made for.
#pragma once

#include <cfenv>

namespace sonoglide::fmi {

/// While it lives, floating point is as at the start of a program: an importer may have set
/// flush-to-zero, with which the bits of a simulation change. Afterwards it is as the importer had
/// it, with the importer's own flags.
class OwnFloatingPoint {
 public:
  OwnFloatingPoint() {
    std::fegetenv(&kept_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~OwnFloatingPoint() { std::fesetenv(&kept_); }
  OwnFloatingPoint(const OwnFloatingPoint&) = delete;
  OwnFloatingPoint& operator=(const OwnFloatingPoint&) = delete;

 private:
  std::fenv_t kept_{};
};

}  // namespace sonoglide::fmi
