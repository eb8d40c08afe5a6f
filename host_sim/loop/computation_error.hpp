/// A simulation that could not be carried through.
#pragma once

#include <stdexcept>

namespace sonoglide::loop {

/// The computation failed; what() gives time, state and reason.
class ComputationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace sonoglide::loop
