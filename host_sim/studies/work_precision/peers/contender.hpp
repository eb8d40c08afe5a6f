/// A solver at one setting, as a work-precision comparison drives it.
#pragma once

#include <cstdint>
#include <string>

namespace sonoglide::peers {

class Contender {
 public:
  Contender() = default;
  virtual ~Contender() = default;
  Contender(const Contender&) = delete;
  Contender& operator=(const Contender&) = delete;

  /// Back to the beginning of the run.
  virtual void restart() = 0;

  /// Goes on to the end of at least so many more carrier periods, never past the end of the run. A
  /// method that chooses its own steps need not end one there: how a run is cut into calls changes
  /// nothing in it.
  /// @return why the run cannot go on; empty if nothing is wrong
  virtual std::string advance(int periods) = 0;

  /// Integral of phi over tau since the beginning.
  virtual double friction_integral() const = 0;
  /// Steps taken since the beginning.
  virtual std::uint64_t steps() const = 0;
};

}  // namespace sonoglide::peers
