/// A program that cannot be used.
#pragma once

#include <stdexcept>

namespace sonoglide::process {

/// what() names the program and the reason.
class ProcessError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace sonoglide::process
