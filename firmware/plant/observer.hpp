/// Who watches a motion. A solver calls its observer once for each accepted step.
#pragma once

namespace sonoglide::plant {

/// Observes nothing. Every other observer is a callable too. The step that it is given offers
///   begin(), length()   time since the beginning of the interval, and duration of the step
///   at(offset)          State at begin() + offset, offset in [0, length()]
///   friction_integral(), motion_integrals(), …   integrals over the step, see account.hpp
/// and is valid during the call only. An observer sees the motion; it cannot change it.
struct NoObserver {
  template <class Step>
  void operator()(const Step& /*step*/) const {}
};

}  // namespace sonoglide::plant
