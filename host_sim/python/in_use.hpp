/// An object that computes without the interpreter's lock belongs to one thread meanwhile.
#pragma once

#include <stdexcept>

namespace sonoglide::python {

/// Made and destroyed with the interpreter's lock held.
class InUse {
 public:
  /// @throws std::runtime_error  another thread uses it
  explicit InUse(bool& used) : used_(used) {
    if (used_) {
      throw std::runtime_error("in use by another thread");
    }
    used_ = true;
  }
  ~InUse() { used_ = false; }
  InUse(const InUse&) = delete;
  InUse& operator=(const InUse&) = delete;

 private:
  bool& used_;
};

}  // namespace sonoglide::python
