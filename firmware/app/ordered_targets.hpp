/// The targets of a unit whose host orders every one.
#pragma once

#include "hal/board.hpp"

namespace sonoglide::app {

/// What of a unit's target is not its host's: nothing. TextureCourse stands in its place where the unit has
/// a texture. In each carrier period move() comes first, then the orders, then aim(), then pass().
struct OrderedTargets {
  /// To the place of the sample that comes.
  template <class Controller>
  static constexpr void move(const Controller& /*controller*/) {}
  /// Sets the target of the step, where it is not an order.
  template <class Controller>
  static constexpr void aim(Controller& /*controller*/) {}
  /// Takes a sample.
  template <class Board>
  static constexpr void pass(const hal::Sample& /*sample*/, Board& /*board*/) {}
  /// Whether an ordered target is none of the controller's.
  template <class Scalar>
  static constexpr bool takes(Scalar /*ordered*/) {
    return false;
  }
};

/// Of the targets that are compiled in. See TextureTargets for others.
template <class Board, class Targets>
constexpr OrderedTargets course_of(const Targets& /*targets*/) {
  return {};
}

}  // namespace sonoglide::app
