/// A type as a value, to be chosen among at run time.
#pragma once

namespace sonoglide::configure {

/// Names a type without an object of it.
template <class T>
struct Type {
  using type = T;
};

}  // namespace sonoglide::configure
